// SPDX-License-Identifier: GPL-3.0-or-later
// A smooth function whose zero set is the surface that the vertices of a mesh, or points, are samples of: a blend of
// polynomials that are fitted to them.
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

/// The margin of a band holds points up to a height, and lets them be farther across the higher they are, as above a
/// crease.
struct Band_margin {
  double height = 0, slope = 0;
};

class Fitted_data_3;

/// The interface through which Fitted_function_traits_3 evaluates a fit, in the coordinates of the data.
class Fitted_function_3 {
public:
  using Vector = Eigen::Vector3d;

  virtual ~Fitted_function_3() = default;

  /// The value; not a number outside of the band.
  virtual double value(const Vector& p, const Band_margin& margin) const = 0;
  virtual Jet_3<double, 1> first_order(const Vector& p) const = 0;
  /// The expansion; not a number where the value is not that of polynomials alone.
  virtual Jet_3<double> taylor(const Vector& p) const = 0;
  virtual double rounding(const Vector& p) const = 0;
  virtual Fitted_structure_3<double> structure(const Vector& p) const = 0;
  virtual double spacing(const Vector& p) const = 0;
  virtual Vector on_tangent_plane(const Vector& p) const = 0;
  virtual std::optional<double> scale() const = 0;
  virtual CGAL::Bbox_3 box() const = 0;

  /// Returns the margin up to a height over the surface.
  virtual Band_margin margin(double height) const = 0;

  /// Returns whether some point of a box may be in the band.
  virtual bool may_meet(const CGAL::Bbox_3& box, const Band_margin& margin) const = 0;

  /// The data with the way to fit them.
  virtual const Fitted_data_3& data() const = 0;
};

// The library defines these functions. They run in the threads of TBB if `in_threads`.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Returns the blend of fits to the data.
/// \throw Input_error if an option makes no sense
std::shared_ptr<const Fitted_function_3> fitted_function(bool in_threads, Fit_data_3 given, const Fit_options& options);

/// The sheets of the data that a grid on a box does not tell apart.
Close_sheets close_sheets(bool in_threads, const Fitted_data_3& fit, const CGAL::Bbox_3& box, double longest_step);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

/// How far the affine curvatures of a fit at a point can be trusted, from 0 to 1: 1 / (1 + 10 e) for an estimated error
/// e of the affine Gaussian curvature K as a part of |K| + H^2, which affine maps keep.
template <class FT>
double certainty_of_fit(const Fitted_structure_3<FT>& fit) {
  const auto& affine = fit.structure.affine;
  const FT size = std::abs(affine.gaussian_curvature) + affine.mean_curvature * affine.mean_curvature;
  const FT part = fit.error.affine_gaussian_curvature / size;
  return std::isfinite(part) ? double(1 / (1 + 10 * part)) : 0;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// A smooth function whose zero set is the surface that the vertices of a mesh, or points without faces, are samples
/// of: a model of FirstOrderImplicitFunctionTraits_3 and BoundedImplicitFunctionTraits_3. Near the surface its value is
/// about the signed distance, negative on the side that normals point away from.
///
/// It is a blend of polynomials fitted to the points around centers, chosen by the data as for `fitted_structures`, of
/// which it is the continuous counterpart: sum of w_i g_i / sum of w_i, where g_i is a polynomial that approximates the
/// distance and w_i a weight that vanishes at half the radius of its points (a partition of unity; Ohtake et al.
/// 2003). Expansions are the means of those of the g_i with the same weights, diffuse derivatives (Nayroles et al.
/// 1992): they differ from the derivatives of f by what the polynomials disagree on, and are at least as near to those
/// of the surface as each of them. Another sheet of the surface that is near in space but not connected nearby has no
/// influence.
///
/// It is defined in a band along its zero set: up to 2 spacings of the points from the foot of the nearest one along
/// the normal, and 1.25 across, so that holes larger than that stay holes, and no more than a quarter of a spacing
/// beyond an open border, which therefore stays where it is. Elsewhere the value is not a number; `in_band` makes the
/// band wider. The value is continuous in the band, up to points as far from two sheets: where polynomials know
/// nothing, high above the surface, or are wrong, as beside creases, it is the mean of the heights over the tangent
/// planes at the nearest feet, which has first derivatives, and no curvature. Fits do not reach over creases, see
/// fitted_structures(): each side has its own function there, and the value is the greatest one at convex creases, the
/// least at concave ones.
///
/// Construction takes 1 ms per vertex for exact data and 3 ms for noisy ones, memory is linear; copies share it. A
/// value takes some 5 microseconds, an expansion 8.
template <class Kernel>
class Fitted_function_traits_3 {
public:
  using FT = typename Kernel::FT;             ///< the number type of the kernel
  using Point_3 = typename Kernel::Point_3;   ///< points of the kernel
  using Vector_3 = typename Kernel::Vector_3; ///< vectors of the kernel

  /// From a mesh, a model of CGAL's FaceGraph. The named parameters are those of fitted_structures():
  ///
  /// | named parameter | type | default | meaning |
  /// |---|---|---|---|
  /// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
  /// | `vertex_normal_map` | property map | made of the faces | from vertices to normals |
  /// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
  ///
  /// \throw Input_error if an option makes no sense. \throw std::invalid_argument if a coordinate is not finite.
  template <Face_graph Graph, internal::Parameter_chain Parameters = internal::No_parameters,
            std::derived_from<CGAL::Sequential_tag> ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Fitted_function_traits_3(const Graph& mesh, const Fit_options& options = {}, const Parameters& given = {},
                                    ConcurrencyTag = {})
      : Fitted_function_traits_3(
            internal::fitted_function(runs_in_threads<ConcurrencyTag>(),
                                      internal::fit_data_of_graph(mesh, internal::joined_parameters(given)), options)) {
    internal::check_mesh_fit_parameters<internal::Joined_parameters<Parameters>>();
  }

  /// From points. In the place of `vertex_point_map` and `vertex_normal_map` there are
  ///
  /// | named parameter | type | default | meaning |
  /// |---|---|---|---|
  /// | `point_map` | property map | the elements | from elements to points |
  /// | `normal_map` | property map | estimated | from elements to normals |
  ///
  /// \throw Input_error if an option makes no sense. \throw std::invalid_argument if a coordinate is not finite.
  template <std::ranges::input_range Points, internal::Parameter_chain Parameters = internal::No_parameters,
            std::derived_from<CGAL::Sequential_tag> ConcurrencyTag = CGAL::Parallel_if_available_tag>
  explicit Fitted_function_traits_3(const Points& points, const Fit_options& options = {}, const Parameters& given = {},
                                    ConcurrencyTag = {}) requires(!Face_graph<Points>)
      : Fitted_function_traits_3(internal::fitted_function(
            runs_in_threads<ConcurrencyTag>(), internal::fit_data_of_points(points, internal::joined_parameters(given)),
            options)) {
    internal::check_point_fit_parameters<internal::Joined_parameters<Parameters>>();
  }

  /// From points with polygons between them, ranges of positions of points, which need not be a mesh. The named
  /// parameters are those of a mesh without the two maps.
  /// \throw std::invalid_argument also if a polygon has the position of no point.
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

  /// The same function, to be sampled in another box.
  Fitted_function_traits_3 in_box(const CGAL::Bbox_3& box) const {
    Fitted_function_traits_3 copy = *this;
    copy.box_ = box;
    return copy;
  }

  /// The same function with values up to that height over the surface. Beyond 2 spacings of the points there are no
  /// derivatives. Marching Cubes on a grid that is coarser than the points need this: the
  /// height is the diagonal of a cell.
  Fitted_function_traits_3 in_band(const FT& height) const {
    Fitted_function_traits_3 copy = *this;
    copy.margin_ = function_->margin(CGAL::to_double(height));
    return copy;
  }

  /// The value; not a number outside of the band.
  FT value(const Point_3& p) const { return FT(function_->value(coordinates_of(p), margin_)); }

  /// The value and the gradient, which is a diffuse derivative where polynomials are blended.
  Jet_3<FT, 1> first_order(const Point_3& p) const { return converted(function_->first_order(coordinates_of(p))); }

  /// The expansion where the value is that of polynomials; not a number elsewhere.
  Jet_3<FT> taylor(const Point_3& p) const { return converted(function_->taylor(coordinates_of(p))); }

  /// The whole line for a box that meets the band, as far as boxes around the data tell, and 1 for one where the
  /// function has no value, so that Marching Cubes visits the band alone.
  Interval bounds(const CGAL::Bbox_3& box) const {
    return function_->may_meet(box, margin_) ? Interval::whole() : Interval(1);
  }

  /// The errors of second derivatives at a point that roundings of the data make; infinity where K_e is zero within its
  /// estimated error.
  FT rounding(const Point_3& p) const { return FT(function_->rounding(coordinates_of(p))); }

  /// The structure of the level set through a point, with estimates of the errors as `fitted_structures` has them for
  /// the data, the geometric means of those of the polynomials that are blended there. OUTSIDE where the function has
  /// no derivatives.
  Fitted_structure_3<double> structure(const Point_3& p) const { return function_->structure(coordinates_of(p)); }

  /// How far the affine curvatures there can be trusted, by their estimated errors: see `equiaffine::certainty`.
  double certainty(const Point_3& p) const { return internal::certainty_of_fit(structure(p)); }

  /// The scale of the curvatures, in the unit of the points; nothing if they are the surface's own.
  std::optional<double> scale() const { return function_->scale(); }

  /// The distance of the points around the one whose foot is nearest to p, in their unit of length.
  FT spacing(const Point_3& p) const { return FT(function_->spacing(coordinates_of(p))); }

  /// The point of the tangent plane of the zero set at the nearest foot of a datum that is under or above p there, in
  /// the coordinates in which data have no preferred direction, or p itself if the fit has no polynomials. The function
  /// has derivatives there more often than at p.
  Point_3 on_tangent_plane(const Point_3& p) const {
    const Eigen::Vector3d q = function_->on_tangent_plane(coordinates_of(p));
    return Point_3(FT(q[0]), FT(q[1]), FT(q[2]));
  }

  /// The sheets of the surface that Marching Cubes on a grid on bbox() does not tell apart, where `longest_step` is the
  /// longest one of the steps of the grid. These are data beside others that are not connected with them nearby, or
  /// have opposed normals.
  template <class ConcurrencyTag = CGAL::Sequential_tag>
  Close_sheets close_sheets(const FT& longest_step) const {
    return internal::close_sheets(runs_in_threads<ConcurrencyTag>(), function_->data(), box_,
                                  CGAL::to_double(longest_step));
  }

  /// The box of the band, or the one that `in_box` was given. It is CGAL::Bbox_3() if no polynomial could be fitted.
  CGAL::Bbox_3 bbox() const { return box_; }

  /// The box of the band, whatever `in_box` was given.
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
  internal::Band_margin margin_; ///< in normal coordinates
};

} // namespace equiaffine

#endif
