// SPDX-License-Identifier: GPL-3.0-or-later
// A smooth function whose zero set is the surface sampled by the vertices of a mesh or by points: a blend of fitted
// polynomials.
#ifndef EQUIAFFINE_FIT_FITTED_FUNCTION_TRAITS_3_H
#define EQUIAFFINE_FIT_FITTED_FUNCTION_TRAITS_3_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Close_sheets.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/number/Interval.h>
#include <equiaffine/number/Jet_3.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>
#include <CGAL/tags.h>
#include <Eigen/Core>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <ranges>
#include <utility>

namespace equiaffine::internal {

/// The margin of a band. It contains points up to a height; the higher a point, the farther to the side it may be,
/// as above a crease.
struct Band_margin {
  double height = 0, slope = 0;
};

class Fitted_data_3;

/// The interface through which Fitted_function_traits_3 evaluates a fit, in the coordinates of the data.
class Fitted_function_3 {
public:
  using Vector = Eigen::Vector3d;

  virtual ~Fitted_function_3() = default;

  /// NaN outside of the band.
  virtual double value(const Vector& p, const Band_margin& margin) const = 0;
  virtual Jet_3<double, 1> first_order(const Vector& p) const = 0;
  /// NaN where the value is not that of polynomials alone.
  virtual Jet_3<double> taylor(const Vector& p) const = 0;
  virtual double rounding(const Vector& p) const = 0;
  virtual Fitted_structure_3<double> structure(const Vector& p) const = 0;
  virtual double spacing(const Vector& p) const = 0;
  virtual Vector on_tangent_plane(const Vector& p) const = 0;
  virtual std::optional<double> scale() const = 0;
  virtual CGAL::Bbox_3 box() const = 0;

  /// Returns the margin of a band up to a height above the surface.
  virtual Band_margin margin(double height) const = 0;

  /// Returns whether the band may contain a point of the box.
  virtual bool may_meet(const CGAL::Bbox_3& box, const Band_margin& margin) const = 0;

  /// The data and how to fit them.
  virtual const Fitted_data_3& data() const = 0;
};

// Defined in the library. They use TBB threads if `in_threads`.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Returns the blend of fits to the data.
/// \throw Input_error if an option is invalid
std::shared_ptr<const Fitted_function_3> fitted_function(bool in_threads, Fit_data_3 given, const Fit_options& options);

/// Returns the sheets of the data that a grid on the box does not separate.
Close_sheets close_sheets(bool in_threads, const Fitted_data_3& fit, const CGAL::Bbox_3& box, double longest_step);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

/// Confidence in the affine curvatures of a fit at a point, from 0 to 1: 1 / (1 + 10 e), where e is the estimated
/// error of the affine Gaussian curvature K relative to |K| + H^2. The ratio is invariant under affine maps.
template <class FT>
double certainty_of_fit(const Fitted_structure_3<FT>& fit) {
  const auto& affine = fit.structure.affine;
  const FT size = std::abs(affine.gaussian_curvature) + affine.mean_curvature * affine.mean_curvature;
  const FT part = fit.error.affine_gaussian_curvature / size;
  return std::isfinite(part) ? double(1 / (1 + 10 * part)) : 0;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// A smooth function whose zero set is the surface sampled by the vertices of a mesh, or by points without faces.
/// Model of FirstOrderImplicitFunctionTraits_3 and BoundedImplicitFunctionTraits_3. Near the surface its value
/// approximates the signed distance, negative on the side opposite to the normals.
///
/// The function is the continuous counterpart of `fitted_structures`, which describes how polynomials are chosen. It
/// is a partition of unity (Ohtake et al. 2003), f = sum of w_i g_i / sum of w_i. The polynomial g_i, fitted to the
/// points around a center, approximates the distance; the weight w_i vanishes at half the radius of these points.
/// Expansions are the means of those of the g_i with the same weights, that is, diffuse derivatives (Nayroles et al.
/// 1992). They differ from the derivatives of f by the disagreement of the polynomials, and are at least as close to
/// those of the surface as each polynomial's. Another sheet of the surface has no influence if it is close in space
/// but not connected nearby.
///
/// The domain is a band along the zero set. It extends from the foot of the nearest point by up to 2 spacings of the
/// points along the normal and 1.25 across, so larger holes stay holes. Beyond an open border it extends by at most
/// a quarter of a spacing, so the border stays where it is. Elsewhere the value is NaN; `in_band` widens the band.
/// The value is continuous in the band, except at points equally far from two sheets. High above the surface and
/// beside creases, where polynomials are undefined or wrong, it is the mean of the heights above the tangent planes
/// at the nearest feet. That mean has first derivatives, but no curvature. Fits do not extend across creases, see
/// fitted_structures(): each side has its own function there, and the value is their maximum at convex creases and
/// their minimum at concave ones.
///
/// Construction takes 1 ms per vertex for exact data and 3 ms for noisy data; memory is linear, and copies share it.
/// A value takes about 5 microseconds, an expansion 8.
template <class Kernel>
class Fitted_function_traits_3 {
public:
  using FT = typename Kernel::FT;             ///< the number type of the kernel
  using Point_3 = typename Kernel::Point_3;   ///< points of the kernel
  using Vector_3 = typename Kernel::Vector_3; ///< vectors of the kernel

  /// Fits a mesh, a model of CGAL's FaceGraph. `geom_traits` and `verbose` are accepted for compatibility with CGAL,
  /// and ignored.
  ///
  /// | named parameter | type | default | meaning |
  /// |---|---|---|---|
  /// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
  /// | `vertex_normal_map` | property map | computed from the faces | from vertices to normals |
  ///
  /// \throw Input_error if an option is invalid. \throw std::invalid_argument if a coordinate is not finite.
  template <Face_graph Graph, internal::Parameter_chain Parameters = internal::No_parameters,
            std::derived_from<CGAL::Sequential_tag> ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Fitted_function_traits_3(const Graph& mesh, const Fit_options& options = {}, const Parameters& given = {},
                                    ConcurrencyTag = {})
      : Fitted_function_traits_3(
            internal::fitted_function(runs_in_threads<ConcurrencyTag>(),
                                      internal::fit_data_of_graph(mesh, internal::joined_parameters(given)), options)) {
    internal::check_mesh_fit_parameters<internal::Joined_parameters<Parameters>>();
  }

  /// Fits points. The named parameters are those of a mesh, in the place of `vertex_point_map` and
  /// `vertex_normal_map`:
  ///
  /// | named parameter | type | default | meaning |
  /// |---|---|---|---|
  /// | `point_map` | property map | the elements | from elements to points |
  /// | `normal_map` | property map | estimated | from elements to normals |
  ///
  /// \throw Input_error if an option is invalid. \throw std::invalid_argument if a coordinate is not finite.
  template <std::ranges::input_range Points, internal::Parameter_chain Parameters = internal::No_parameters,
            std::derived_from<CGAL::Sequential_tag> ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Fitted_function_traits_3(const Points& points, const Fit_options& options = {}, const Parameters& given = {},
                                    ConcurrencyTag = {}) requires(!Face_graph<Points>)
      : Fitted_function_traits_3(internal::fitted_function(
            runs_in_threads<ConcurrencyTag>(), internal::fit_data_of_points(points, internal::joined_parameters(given)),
            options)) {
    internal::check_point_fit_parameters<internal::Joined_parameters<Parameters>>();
  }

  /// Fits a polygon soup: points, and polygons as ranges of point indices. The named parameters are those of a mesh
  /// without the two maps.
  /// \throw std::invalid_argument also if an index is out of range.
  template <std::ranges::input_range Points, std::ranges::input_range Polygons,
            internal::Parameter_chain Parameters = internal::No_parameters,
            std::derived_from<CGAL::Sequential_tag> ConcurrencyTag = CGAL::Parallel_if_available_tag>
  Fitted_function_traits_3(const Points& points, const Polygons& polygons, const Fit_options& options = {},
                           const Parameters& = {}, ConcurrencyTag = {})
      : Fitted_function_traits_3(internal::fitted_function(runs_in_threads<ConcurrencyTag>(),
                                                           internal::fit_data_of_soup(points, polygons), options)) {
    internal::check_fit_parameters<internal::Joined_parameters<Parameters>>();
  }

  /// \cond for internal use
  explicit Fitted_function_traits_3(std::shared_ptr<const internal::Fitted_function_3> function)
      : function_(std::move(function)), box_(function_->box()) {}
  /// \endcond

  /// Returns the same function with another box for sampling.
  Fitted_function_traits_3 in_box(const CGAL::Bbox_3& box) const {
    Fitted_function_traits_3 copy = *this;
    copy.box_ = box;
    return copy;
  }

  /// Returns the same function with values up to that height above the surface. Beyond 2 spacings of the points
  /// there are no derivatives. Marching Cubes needs this on a grid coarser than the points; use the diagonal of a
  /// cell as the height.
  Fitted_function_traits_3 in_band(const FT& height) const {
    Fitted_function_traits_3 copy = *this;
    copy.margin_ = function_->margin(CGAL::to_double(height));
    return copy;
  }

  /// NaN outside of the band.
  FT value(const Point_3& p) const { return FT(function_->value(coordinates_of(p), margin_)); }

  /// The value and the gradient, a diffuse derivative where polynomials are blended.
  Jet_3<FT, 1> first_order(const Point_3& p) const { return converted(function_->first_order(coordinates_of(p))); }

  /// The expansion where the value is that of polynomials; NaN elsewhere.
  Jet_3<FT> taylor(const Point_3& p) const { return converted(function_->taylor(coordinates_of(p))); }

  /// The whole real line for a box that may meet the band (tested conservatively against boxes around the data), and
  /// 1 for any other box, so that Marching Cubes visits only the band.
  Interval bounds(const CGAL::Bbox_3& box) const {
    return function_->may_meet(box, margin_) ? Interval::whole() : Interval(1);
  }

  /// The errors of second derivatives at a point due to rounding of the data; infinity where K_e is zero within its
  /// estimated error.
  FT rounding(const Point_3& p) const { return FT(function_->rounding(coordinates_of(p))); }

  /// The structure of the level set through a point. Its error estimates are the geometric means of those of the
  /// polynomials blended there, see `fitted_structures`. OUTSIDE where the function has no derivatives.
  Fitted_structure_3<double> structure(const Point_3& p) const { return function_->structure(coordinates_of(p)); }

  /// Confidence in the affine curvatures at a point, from their estimated errors: see `equiaffine::certainty`.
  double certainty(const Point_3& p) const { return internal::certainty_of_fit(structure(p)); }

  /// The scale of the curvatures, in the unit of the points; nothing if they are those of the surface itself.
  std::optional<double> scale() const { return function_->scale(); }

  /// The spacing of the data around the data point whose foot is nearest to p, in the unit of the data.
  FT spacing(const Point_3& p) const { return FT(function_->spacing(coordinates_of(p))); }

  /// The projection of p to the tangent plane of the zero set at the nearest foot of a data point below or above p,
  /// in the coordinates in which the data have no preferred direction. Returns p itself if the fit has no
  /// polynomials. The function more often has derivatives at the projection than at p.
  Point_3 on_tangent_plane(const Point_3& p) const {
    const Eigen::Vector3d q = function_->on_tangent_plane(coordinates_of(p));
    return Point_3(FT(q[0]), FT(q[1]), FT(q[2]));
  }

  /// The sheets of the surface that Marching Cubes does not separate on a grid on bbox(), whose longest step is
  /// `longest_step`. They consist of data points close to data points that are not connected with them nearby, or
  /// that have opposite normals.
  template <class ConcurrencyTag = CGAL::Sequential_tag>
  Close_sheets close_sheets(const FT& longest_step) const {
    return internal::close_sheets(runs_in_threads<ConcurrencyTag>(), function_->data(), box_,
                                  CGAL::to_double(longest_step));
  }

  /// The box of the band, or the one given to `in_box`. CGAL::Bbox_3() if no polynomial could be fitted.
  CGAL::Bbox_3 bbox() const { return box_; }

  /// The box of the band, even if `in_box` was called.
  CGAL::Bbox_3 band_box() const { return function_->box(); }

private:
  template <int Order>
  static Jet_3<FT, Order> converted(const Jet_3<double, Order>& jet) {
    Jet_3<FT, Order> result;
    for (std::size_t n = 0; n < jet.size; ++n) result.coefficients()[n] = FT(jet.coefficients()[n]);
    return result;
  }

  std::shared_ptr<const internal::Fitted_function_3> function_;
  CGAL::Bbox_3 box_;
  internal::Band_margin margin_; ///< in normalized coordinates
};

} // namespace equiaffine

#endif
