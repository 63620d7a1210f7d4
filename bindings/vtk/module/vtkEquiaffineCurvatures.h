// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkEquiaffineCurvatures_h
#define vtkEquiaffineCurvatures_h

#include "equiaffineVTKModule.h" // For the export macro

#include <vtkPolyDataAlgorithm.h>

/**
 * @class vtkEquiaffineCurvatures
 * @brief curvatures of the smooth surface sampled by the points of a mesh, with estimated errors
 *
 * Polynomials are fitted to the neighborhood of each point. Whereas vtkCurvatures shows angles between faces, and
 * noise, this filter estimates the curvatures of the smooth surface, and the error of each number. Neighbors are
 * determined by the faces; polygons and strips are triangulated. Points without faces are fitted to their nearest
 * points, with the active normals if there are any. It takes about 1 ms per point.
 *
 * The output is the input with additional point data:
 *
 * | array | type | components | meaning |
 * |---|---|---|---|
 * | one array per attribute | double | 1, 3 or 6 | NaN where the quantity does not exist; see SetAttributes() |
 * | NAME`_error` | double | 1 | estimated error of a selected attribute, infinity if unknown; angles in degrees |
 * | `status` | unsigned char | 1 | 0 regular, 1 parabolic, 2 singular, 3 outside: no fit |
 *
 * Of several processes, each fits the points of its own piece, so errors are larger near the boundaries of pieces.
 */
class EQUIAFFINEVTK_EXPORT vtkEquiaffineCurvatures : public vtkPolyDataAlgorithm {
public:
  static vtkEquiaffineCurvatures* New();
  vtkTypeMacro(vtkEquiaffineCurvatures, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The attributes: `all` (the default), `basic`, `none`, or comma-separated names. */
  vtkSetStringMacro(Attributes);
  vtkGetStringMacro(Attributes);
  ///@}

  ///@{
  /** Whether to add arrays of estimated errors; on by default. */
  vtkSetMacro(EstimateErrors, bool);
  vtkGetMacro(EstimateErrors, bool);
  vtkBooleanMacro(EstimateErrors, bool);
  ///@}

  ///@{
  /**
   * The scale of the curvatures, a length; 0, the default, for the surface's own. Scans and coarse meshes need a scale.
   * A negative number chooses it from the data.
   */
  vtkSetMacro(Scale, double);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /** The degree of the polynomials: 4, 5, 6, 8 or 10; 0, the default, chooses it from the data. */
  vtkSetMacro(Degree, int);
  vtkGetMacro(Degree, int);
  ///@}

  ///@{
  /**
   * Fits do not extend across creases: chains of edges whose dihedral angle deviates from flat by more than this angle
   * in degrees; 60 by default, 180 for no creases.
   */
  vtkSetClampMacro(FeatureAngle, double, 0, 180);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  enum { GRADIENT = 0, AGAINST = 1 };
  ///@{
  /** Whether normals are those of the faces (GRADIENT, the default) or the opposite ones (AGAINST). */
  vtkSetClampMacro(Orientation, int, 0, 1);
  vtkGetMacro(Orientation, int);
  void SetOrientationToGradient() { this->SetOrientation(GRADIENT); }
  void SetOrientationToAgainst() { this->SetOrientation(AGAINST); }
  ///@}

protected:
  vtkEquiaffineCurvatures();
  ~vtkEquiaffineCurvatures() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  char* Attributes = nullptr;
  bool EstimateErrors = true;
  double Scale = 0;
  int Degree = 0;
  double FeatureAngle = 60;
  int Orientation = GRADIENT;

private:
  vtkEquiaffineCurvatures(const vtkEquiaffineCurvatures&) = delete;
  void operator=(const vtkEquiaffineCurvatures&) = delete;
};

#endif
