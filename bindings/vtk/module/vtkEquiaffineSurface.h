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
 * The input is a vtkImageData, or a composite data set such as a vtkPartitionedDataSet whose images are pieces of one
 * image. The surface has the topology of the trilinear interpolant. Its points lie on the level set of a spline through
 * the samples, whose derivatives up to order four determine the structure there. Images can have any numeric type of
 * VTK, any direction matrix, including left-handed ones, and any extent. NaN marks a point without a value, at which
 * the surface ends. Hidden points are used like other points.
 *
 * The output is a vtkPolyData of triangles with:
 *
 * | point data | type | components | meaning |
 * |---|---|---|---|
 * | one array per attribute | double | 1, 3 or 6 | NaN where the quantity does not exist; see SetAttributes() |
 * | `normal` | double | 3 | one of the attributes, and the active normals |
 * | `affine_gaussian_curvature_error`, `affine_mean_curvature_error` | double | 1 | estimated errors of these attributes; see SetEstimateErrors() |
 * | `status` | unsigned char | 1 | 0 regular, 1 parabolic, 2 singular, 3 outside, 4 unconverged |
 * | `vertex_id` | vtkIdType | 1 | global ids: equal ids in different pieces are the same vertex |
 * | `vtkGhostType` | unsigned char | 1 | with several pieces: 1 for a point that belongs to another piece |
 *
 * | cell data | type | components | meaning |
 * |---|---|---|---|
 * | `vtkGhostType` | unsigned char | 1 | if ghost cells are requested: 1 for a triangle of another piece |
 *
 * | field data | type | tuples x components | meaning |
 * |---|---|---|---|
 * | `vertices`, `triangles` | vtkIdType | 1 x 1 | counts over all pieces; shared elements count once |
 * | `smoothing` | double | 1 x 1 | scale of the smoothing of the samples, set or chosen |
 * | `noise` | double | 1 x 1 | standard deviation of the noise of the samples, if needed for errors or smoothing |
 * | `status_counts` | vtkIdType | 1 x 5 | number of vertices with each status, if `status` is selected |
 * | NAME`_range` | double | 1 x 2 | minimum and maximum of a scalar attribute; NaN, NaN if it exists nowhere |
 *
 * Each process meshes its own piece. Without EstimateErrors, the union of the pieces and the field data are bit for bit
 * those of the whole image. The filter requests the ghost levels that it needs (GetNumberOfGhostLevels()) upstream, or
 * exchanges them between processes if the source does not provide them. It must execute in all processes with the same
 * properties. One process can also make the pieces one after the other; it then requests the whole image, and the field
 * data are those of a piece. Pieces can differ where more than four consecutive points have the level exactly and the
 * image is less around them: such parts of the surface, which have no area, are dropped if a piece contains all of
 * them, and otherwise have triangles smaller than 1e-6 of the spacing.
 *
 * The active scalars are the quantity that pages of the program show by default, the first one that is known. Warnings
 * list curvatures that are unknown at most vertices, and point out samples with few distinct values, whose curvatures
 * show the steps between them.
 *
 * After an error the output is empty.
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
   * How the spline is computed from the samples: QUASI_INTERPOLATION by default. CONVOLUTION smooths, and needs up to
   * three ghost levels fewer. INTERPOLATION needs the whole image in one process.
   */
  vtkSetClampMacro(SplineScheme, int, 0, 2);
  vtkGetMacro(SplineScheme, int);
  void SetSplineSchemeToQuasiInterpolation() { this->SetSplineScheme(QUASI_INTERPOLATION); }
  void SetSplineSchemeToConvolution() { this->SetSplineScheme(CONVOLUTION); }
  void SetSplineSchemeToInterpolation() { this->SetSplineScheme(INTERPOLATION); }
  ///@}

  ///@{
  /** Scale of the smoothing of the samples, in points; 0, the default, and values up to 1 do nothing. Scans need it. */
  vtkSetClampMacro(Smoothing, double, 0, 100);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /**
   * Whether to choose the scale of smoothing from the noise near the surface, instead of SetSmoothing(): the one with
   * the smallest estimated error of fourth derivatives that does not move the surface; it can be 0. Off by default,
   * since pieces need 51 ghost levels for it. The choice does not depend on the number of processes.
   */
  vtkSetMacro(AutomaticSmoothing, bool);
  vtkGetMacro(AutomaticSmoothing, bool);
  vtkBooleanMacro(AutomaticSmoothing, bool);
  ///@}

  ///@{
  /**
   * Whether to estimate the errors of affine curvatures, which takes as long as all attributes; on by default. This
   * needs the whole image in each process; otherwise the filter warns, and chooses different active scalars.
   */
  vtkSetMacro(EstimateErrors, bool);
  vtkGetMacro(EstimateErrors, bool);
  vtkBooleanMacro(EstimateErrors, bool);
  ///@}

  ///@{
  /**
   * Whether to replace unknown affine curvatures, whose estimated error exceeds half of their size, by NaN, which
   * ParaView shows in a separate color; on by default.
   */
  vtkSetMacro(HideUnknown, bool);
  vtkGetMacro(HideUnknown, bool);
  vtkBooleanMacro(HideUnknown, bool);
  ///@}

  ///@{
  /**
   * The attributes: `all` (the default), `basic`, `none`, or comma-separated names. `signature`, the affine curvatures
   * with the norms of their gradients, takes 40 times as long. The manual lists all names.
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
  /** The component of the array to use, counted from 0; 0 by default. */
  vtkSetClampMacro(ArrayComponent, int, 0, VTK_INT_MAX);
  vtkGetMacro(ArrayComponent, int);
  ///@}

  ///@{
  /** The controller of the processes that have pieces of the image; the global controller by default. */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  /** The number of ghost levels of the image that a piece needs; 0 for INTERPOLATION, which does not support pieces. */
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
