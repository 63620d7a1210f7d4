// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkEquiaffineCurvatures_h
#define vtkEquiaffineCurvatures_h

#include "equiaffineVTKModule.h" // For the export macro

#include <vtkPolyDataAlgorithm.h>

/**
 * @class vtkEquiaffineCurvatures
 * @brief curvatures of the surface that the points of a mesh are samples of, and their estimated errors
 *
 * Polynomials are fitted to the points around each. Where vtkCurvatures shows the angles of the faces, and noise, this
 * filter shows the smooth surface, as far as the points tell it, and says how far: every number has an estimate of its
 * error. Faces say which points are neighbors; polygons and strips are cut into triangles. Points without faces are
 * fitted by their nearest points, with the active normals if there are some. About 1 ms per point.
 *
 * The output is the input with more point data, for n points:
 *
 * | array | type | components | meaning |
 * |---|---|---|---|
 * | one array per attribute | double | 1, 3 or 6 | NaN where the quantity does not exist; see SetAttributes() |
 * | NAME`_error` | double | 1 | the estimated error of a selected attribute, infinity if nothing is known; angles in degrees |
 * | `status` | unsigned char | 1 | 0 regular, 1 parabolic, 2 singular, 3 outside: no fit |
 *
 * In several processes each fits the points of its piece, so that numbers beside the edge of a piece have larger
 * errors.
 */
class EQUIAFFINEVTK_EXPORT vtkEquiaffineCurvatures : public vtkPolyDataAlgorithm {
public:
  static vtkEquiaffineCurvatures* New();
  vtkTypeMacro(vtkEquiaffineCurvatures, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The attributes: `all` by default, `basic`, `none`, or names with commas between them. */
  vtkSetStringMacro(Attributes);
  vtkGetStringMacro(Attributes);
  ///@}

  ///@{
  /** Whether there are arrays of estimated errors; on by default. */
  vtkSetMacro(EstimateErrors, bool);
  vtkGetMacro(EstimateErrors, bool);
  vtkBooleanMacro(EstimateErrors, bool);
  ///@}

  ///@{
  /**
   * The scale of the curvatures, a length, which scans and coarse meshes need; 0, the default, for the surface's own. A
   * negative number lets the data choose.
   */
  vtkSetMacro(Scale, double);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /** The degree of the polynomials: 4, 5, 6, 8 or 10; 0, the default, lets the data choose. */
  vtkSetMacro(Degree, int);
  vtkGetMacro(Degree, int);
  ///@}

  ///@{
  /** Fits do not reach over edges that bend by more than this angle in degrees; 60 by default, and 180 for none. */
  vtkSetClampMacro(FeatureAngle, double, 0, 180);
  vtkGetMacro(FeatureAngle, double);
  ///@}

  enum { GRADIENT = 0, AGAINST = 1 };
  ///@{
  /** Whether normals are those of the faces, GRADIENT, the default, or AGAINST, the opposite ones. */
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
