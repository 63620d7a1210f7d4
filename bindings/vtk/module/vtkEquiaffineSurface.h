// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkEquiaffineSurface_h
#define vtkEquiaffineSurface_h

#include "equiaffineVTKModule.h" // For the export macro

#include <vtkPolyDataAlgorithm.h>

class vtkMultiProcessController;

#ifndef __VTK_WRAP__
namespace equiaffine {
struct Volume_options;
}
#endif

/**
 * @class vtkEquiaffineSurface
 * @brief extracts an isosurface of an image, with its Euclidean and equi-affine structure
 *
 * The surface is that of the spline through the samples of a vtkImageData, or of the images of a composite data set
 * such as a vtkPartitionedDataSet, which are pieces of one image. Its topology is that of the trilinear interpolant;
 * its points lie on the level set of the spline, whose derivatives up to order four give the structure there. An image
 * has one of the numeric types of VTK, any direction matrix, left-handed ones included, and any extent. NaN marks a
 * point without a value, at which the surface ends.
 *
 * The output is a vtkPolyData of triangles with, for n points:
 *
 * | point data | type | components | meaning |
 * |---|---|---|---|
 * | one array per attribute | double | 1, 3 or 6 | NaN where the quantity does not exist; see SetAttributes() |
 * | `normal` | double | 3 | among the attributes, and the active normals |
 * | `affine_gaussian_curvature_error`, `affine_mean_curvature_error` | double | 1 | estimated errors of these attributes; see SetEstimateErrors() |
 * | `status` | unsigned char | 1 | 0 regular, 1 parabolic, 2 singular, 3 outside, 4 unconverged |
 * | `vertex_id` | vtkIdType | 1 | global ids: equal in all pieces, of which equal ones are one vertex |
 * | `vtkGhostType` | unsigned char | 1 | with several pieces: 1 for a point that belongs to another piece |
 *
 * | cell data | type | components | meaning |
 * |---|---|---|---|
 * | `vtkGhostType` | unsigned char | 1 | if ghost cells were asked for: 1 for a triangle of another piece |
 *
 * | field data | type | tuples x components | meaning |
 * |---|---|---|---|
 * | `vertices`, `triangles` | vtkIdType | 1 x 1 | of all pieces together, each counted once |
 * | `smoothing` | double | 1 x 1 | the scale by which samples were smoothed, which is set or chosen |
 * | `noise` | double | 1 x 1 | the standard deviation of the noise of the samples, where errors or the smoothing need it |
 * | `status_counts` | vtkIdType | 1 x 5 | how many vertices have each status |
 * | NAME`_range` | double | 1 x 2 | least and greatest value of a scalar attribute; NaN, NaN if it exists nowhere |
 *
 * In several processes every one meshes its piece, and all pieces together are the mesh of the whole image without
 * EstimateErrors, bit for bit, as are the field data. The filter asks upstream for the ghost levels that it needs
 * (GetNumberOfGhostLevels()), and gets them from the pieces beside if the source has none. It must execute in all
 * processes, with the same properties. One process may make the pieces one after the other: it then asks for the whole
 * image, and field data are of a piece. Pieces may differ where the image has the level at more than four points in a
 * row and is less around them: such parts without area are dropped if they are known whole, and else have triangles of
 * less than 1e-6 of the spacing.
 *
 * Hidden points count as others. The status_counts are there with the status.
 *
 * The active scalars are what the pages of the program show first: the quantity that is known first. Warnings say which
 * curvatures are unknown at most vertices, and that samples of few distinct values have curvatures of steps.
 *
 * An error is reported in one sentence, and leaves an empty output.
 */
class EQUIAFFINEVTK_EXPORT vtkEquiaffineSurface : public vtkPolyDataAlgorithm {
public:
  static vtkEquiaffineSurface* New();
  vtkTypeMacro(vtkEquiaffineSurface, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The value of the level set; 0 by default. */
  vtkSetMacro(Level, double);
  vtkGetMacro(Level, double);
  ///@}

  ///@{
  /** The degree of the spline: 5, 7 or 9; 7 by default. */
  vtkSetMacro(SplineDegree, int);
  vtkGetMacro(SplineDegree, int);
  ///@}

  enum { QUASI_INTERPOLATION = 0, CONVOLUTION = 1, INTERPOLATION = 2 };
  ///@{
  /**
   * How samples become a spline: QUASI_INTERPOLATION by default. CONVOLUTION smooths, and needs up to three ghost
   * levels less. INTERPOLATION needs the whole image in one process.
   */
  vtkSetClampMacro(SplineScheme, int, 0, 2);
  vtkGetMacro(SplineScheme, int);
  void SetSplineSchemeToQuasiInterpolation() { this->SetSplineScheme(QUASI_INTERPOLATION); }
  void SetSplineSchemeToConvolution() { this->SetSplineScheme(CONVOLUTION); }
  void SetSplineSchemeToInterpolation() { this->SetSplineScheme(INTERPOLATION); }
  ///@}

  ///@{
  /** The scale in points by which samples are smoothed first, which scans need; 0, the default, and up to 1: not. */
  vtkSetClampMacro(Smoothing, double, 0, 100);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /**
   * Whether the scale of smoothing is chosen, whatever SetSmoothing() says: the one with the least estimated error of
   * fourth derivatives that leaves the surface where it is, from the noise beside it; 0 for none. Off by default, since
   * pieces need 51 ghost levels for it. All processes choose the scale that one process chooses.
   */
  vtkSetMacro(AutomaticSmoothing, bool);
  vtkGetMacro(AutomaticSmoothing, bool);
  vtkBooleanMacro(AutomaticSmoothing, bool);
  ///@}

  ///@{
  /**
   * Whether the errors of affine curvatures are estimated, which takes as long again as all attributes; on by default.
   * This needs the whole image in each process: else a warning says so, and the active scalars are other ones.
   */
  vtkSetMacro(EstimateErrors, bool);
  vtkGetMacro(EstimateErrors, bool);
  vtkBooleanMacro(EstimateErrors, bool);
  ///@}

  ///@{
  /**
   * Whether affine curvatures that are unknown are NaN, for which ParaView has a color of its own: their estimated
   * error is more than half of their size; on by default.
   */
  vtkSetMacro(HideUnknown, bool);
  vtkGetMacro(HideUnknown, bool);
  vtkBooleanMacro(HideUnknown, bool);
  ///@}

  ///@{
  /**
   * The attributes: `all` by default, `basic`, `none`, or names with commas between them. `signature`, the affine
   * curvatures with the norms of their gradients, takes 40 times as long. The manual lists all names.
   */
  vtkSetStringMacro(Attributes);
  vtkGetStringMacro(Attributes);
  ///@}

  enum { GRADIENT = 0, AGAINST = 1 };
  ///@{
  /** Whether normals point along the GRADIENT of the image, the default, or AGAINST it. */
  vtkSetClampMacro(Orientation, int, 0, 1);
  vtkGetMacro(Orientation, int);
  void SetOrientationToGradient() { this->SetOrientation(GRADIENT); }
  void SetOrientationToAgainst() { this->SetOrientation(AGAINST); }
  ///@}

  enum { PROJECTED = 0, LINEAR = 1 };
  ///@{
  /**
   * Where vertices lie: PROJECTED on the level set of the spline, the default, or on that of the LINEAR interpolant.
   */
  vtkSetClampMacro(Vertices, int, 0, 1);
  vtkGetMacro(Vertices, int);
  void SetVerticesToProjected() { this->SetVertices(PROJECTED); }
  void SetVerticesToLinear() { this->SetVertices(LINEAR); }
  ///@}

  ///@{
  /** The component of the scalars that is the function; 0 by default. */
  vtkSetClampMacro(ArrayComponent, int, 0, VTK_INT_MAX);
  vtkGetMacro(ArrayComponent, int);
  ///@}

  ///@{
  /** The processes that have pieces of the image; the global controller by default. */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  /**
   * The ghost levels of the image that a piece needs with these properties: 0 for INTERPOLATION, which has no pieces.
   */
  int GetNumberOfGhostLevels();

protected:
  vtkEquiaffineSurface();
  ~vtkEquiaffineSurface() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double Level = 0;
  int SplineDegree = 7;
  int SplineScheme = QUASI_INTERPOLATION;
  double Smoothing = 0;
  bool AutomaticSmoothing = false;
  bool EstimateErrors = true;
  bool HideUnknown = true;
  char* Attributes = nullptr;
  int Orientation = GRADIENT;
  int Vertices = PROJECTED;
  int ArrayComponent = 0;
  vtkMultiProcessController* Controller = nullptr;

private:
#ifndef __VTK_WRAP__
  equiaffine::Volume_options GetOptions() const;
#endif
  vtkEquiaffineSurface(const vtkEquiaffineSurface&) = delete;
  void operator=(const vtkEquiaffineSurface&) = delete;
};

#endif
