// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkEquiaffineFunction_h
#define vtkEquiaffineFunction_h

#include "equiaffineVTKModule.h" // For the export macro

#include <vtkImplicitFunction.h>

#ifndef __VTK_WRAP__
#include <memory> // For std::unique_ptr

namespace equiaffine {
class Any_function_3;
}
#endif

/**
 * @class vtkEquiaffineFunction
 * @brief a vtkImplicitFunction given by a formula, or by any model of ImplicitFunctionTraits_3
 *
 * You can use it to sample, clip and cut like any other implicit function. Values and gradients are NaN outside the
 * domain of the function. To mesh any vtkImplicitFunction, sample it with vtkSampleFunction, and apply
 * vtkEquiaffineSurface to the image.
 */
class EQUIAFFINEVTK_EXPORT vtkEquiaffineFunction : public vtkImplicitFunction {
public:
  static vtkEquiaffineFunction* New();
  vtkTypeMacro(vtkEquiaffineFunction, vtkImplicitFunction);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Sets the function to a formula in x, y and z, such as `x^2+y^2+z^2-1`. If the formula is invalid, reports an error
   * and keeps the previous function.
   */
  void SetFormula(const char* formula);

#ifndef __VTK_WRAP__
  /** Sets the function. Any_function_3::make() converts any model of ImplicitFunctionTraits_3. */
  void SetFunction(const equiaffine::Any_function_3& function);
#endif

  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override;            ///< the value, or 0 if no function is set
  void EvaluateGradient(double x[3], double g[3]) override; ///< the gradient, or 0 if no function is set

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
