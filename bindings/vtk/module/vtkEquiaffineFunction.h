// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkEquiaffineFunction_h
#define vtkEquiaffineFunction_h

#include "equiaffineVTKModule.h" // For the export macro

#include <vtkImplicitFunction.h>

#ifndef __VTK_WRAP__
#include <memory> // For what holds the function

namespace equiaffine {
class Any_function_3;
}
#endif

/**
 * @class vtkEquiaffineFunction
 * @brief a function of equiaffine as a vtkImplicitFunction: a formula, or any model of ImplicitFunctionTraits_3
 *
 * It may be sampled, clip and cut like every other implicit function. Outside of the domain of the function, values and
 * gradients are NaN. The other way round, vtkSampleFunction makes an image of an implicit function, and
 * vtkEquiaffineSurface a surface of that image.
 */
class EQUIAFFINEVTK_EXPORT vtkEquiaffineFunction : public vtkImplicitFunction {
public:
  static vtkEquiaffineFunction* New();
  vtkTypeMacro(vtkEquiaffineFunction, vtkImplicitFunction);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Sets the function by a formula in x, y and z, such as `x^2+y^2+z^2-1`. An error in it is reported, and leaves the
   * function as it is.
   */
  void SetFormula(const char* formula);

#ifndef __VTK_WRAP__
  /** Sets the function, as Any_function_3::make() makes it of any model of ImplicitFunctionTraits_3. */
  void SetFunction(const equiaffine::Any_function_3& function);
#endif

  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override;            ///< the value, or 0 before a function is set
  void EvaluateGradient(double x[3], double g[3]) override; ///< the gradient, or 0 before a function is set

protected:
  vtkEquiaffineFunction();
  ~vtkEquiaffineFunction() override;

private:
  vtkEquiaffineFunction(const vtkEquiaffineFunction&) = delete;
  void operator=(const vtkEquiaffineFunction&) = delete;

#ifndef __VTK_WRAP__
  std::unique_ptr<const equiaffine::Any_function_3> Function;
#endif
};

#endif
