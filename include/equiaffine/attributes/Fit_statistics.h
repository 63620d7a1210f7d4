// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of the curvatures of a fit: how well they are known, and why not better.
#ifndef EQUIAFFINE_ATTRIBUTES_FIT_STATISTICS_H
#define EQUIAFFINE_ATTRIBUTES_FIT_STATISTICS_H

#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/attributes/internal/attribute_table.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// Statistics of a fit at the vertices of a mesh or at points.
struct Fit_statistics {
  /// Bounds on relative errors.
  static constexpr std::array<double, 3> error_bounds = {0.1, 0.2, 0.5};
  /// Fractions of the points, from 0 to 1, one for each bound.
  using Parts = std::array<double, error_bounds.size()>;

  std::optional<double> scale = {}; ///< of the curvatures; nothing if they are those of the surface itself
  std::array<double, 3> scales{};   ///< minimum, median and maximum of the scale or radius; NaN without a fit
  double noise = 0;                 ///< median deviation of the data; NaN without a fit
  /// The fractions of the points whose error is below each of `error_bounds`, for each of `rows_with_error`.
  std::array<Parts, rows_with_error.size()> known{};
  double without_fit = 0;        ///< fraction of the points that have no fit
  double parabolic = 0;          ///< fraction of the points that are parabolic
  double doubtful_by_noise = 0;  ///< fraction of the points with an error of K above the last bound, mostly due to
                                 ///< noise
  double doubtful_by_detail = 0; ///< the same, mostly due to disagreement between neighboring fits

  /// The fractions of the points at which an attribute is known. \pre fits estimate its error
  const Parts& known_of(std::string_view attribute) const {
    CGAL_precondition(find_row(attribute)->error.exists());
    return known[find_row(attribute)->error.place];
  }
};

/// The quantities that are invariant or covariant under affine maps of determinant 1, as attributes, in the order of
/// presentation: K, H, J, affine normal, affine area density.
inline constexpr std::array<std::string_view, 5> affine_quantities = {
    "affine_gaussian_curvature", "affine_mean_curvature", "pick_invariant", "affine_normal", "affine_area_density"};

/// Why curvatures of a fit are unknown.
enum class Fit_doubt {
  WITHOUT_FIT, ///< there is no fit at the point
  NOISE,       ///< the error of K is larger than half of its size, mostly due to noise
  DETAIL       ///< the same, because neighboring fits disagree, or have too few points at a scale
};

/// A reason, and the fraction of the points to which it applies, from 0 to 1.
struct Doubt_of_points {
  Fit_doubt reason; ///< why the points are doubtful
  double part;      ///< fraction of all points
};

// Defined in the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Whether an estimate is of the whole error, or of its part due to noise or to detail that a scale omits.
enum class Estimate_kind {
  ERROR, ///< column NAME_error
  NOISE, ///< column NAME_noise
  DETAIL ///< column NAME_detail
};

/// A column with error estimates for an attribute.
struct Estimate_attribute {
  std::string name;                 ///< as in the header of a file
  Estimate_kind kind;               ///< the estimated part of the error
  const Attribute_row<double>* row; ///< row of the attribute
  bool is_of_splines;               ///< whether splines provide it, too

  /// Returns the column for these points.
  Vertex_attributes::Column column(std::span<const Fitted_structure_3<double>> structures) const;
};

/// Returns all estimates in the order of the columns of a file.
const std::vector<Estimate_attribute>& estimate_attributes();

/// Returns the selected attributes of points with these structures; `areas` is empty or as in Sampled_vertices.
Vertex_attributes attributes_of_fit(std::span<const Fitted_structure_3<double>> structures,
                                    const Attribute_selection& selection, std::span<const double> areas = {});

/// Returns the statistics of fits at points, given the structures there.
Fit_statistics statistics_of_fit(std::span<const Fitted_structure_3<double>> structures);

/// Returns the first one of `affine_quantities` that is known to 50 % at half of the points, or K if there is none.
std::string_view first_known(const Fit_statistics& fit);

/// Returns the reasons why K is unknown, if it is unknown at more points than those where it is known to 50 %: each
/// reason that applies to a tenth of these points. Without affine curvatures only points without a fit count.
std::vector<Doubt_of_points> doubts_of(const Fit_statistics& fit, bool has_affine_curvatures = true);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

} // namespace equiaffine

#endif
