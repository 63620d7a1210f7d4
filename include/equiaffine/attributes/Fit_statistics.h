// SPDX-License-Identifier: GPL-3.0-or-later
// What a fit knows of the curvatures at some points, and why it does not know more.
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

/// The facts about a fit at the vertices of a mesh, or at points.
struct Fit_statistics {
  /// Bounds for an estimated error as a part of the size of its number.
  static constexpr std::array<double, 3> error_bounds = {0.1, 0.2, 0.5};
  /// Parts of the points, from 0 to 1, one for each bound.
  using Parts = std::array<double, error_bounds.size()>;

  std::optional<double> scale = {}; ///< of the curvatures; nothing if they are the surface's own
  std::array<double, 3> scales{};   ///< the least, median and greatest scale or radius; NaN if there is no fit
  double noise = 0;                 ///< the median of the deviations of the data; NaN if there is no fit
  /// The parts of the points whose error is below each of `error_bounds`, for each of `rows_with_error`.
  std::array<Parts, rows_with_error.size()> known{};
  double without_fit = 0;        ///< the part of the points that have no fit
  double parabolic = 0;          ///< the part of the points that are parabolic
  double doubtful_by_noise = 0;  ///< with an error of K above the last bound, most of it from noise
  double doubtful_by_detail = 0; ///< the same, most of it from what the fits around disagree on

  /// The parts of the points at which an attribute is known. \pre fits estimate its error
  const Parts& known_of(std::string_view attribute) const {
    CGAL_precondition(find_row(attribute)->error.exists());
    return known[find_row(attribute)->error.place];
  }
};

/// The quantities that affine maps of determinant 1 keep or carry along, as attributes, in the order in which people
/// are told of them: K, H, J, affine normal, affine area density.
inline constexpr std::array<std::string_view, 5> affine_quantities = {
    "affine_gaussian_curvature", "affine_mean_curvature", "pick_invariant", "affine_normal", "affine_area_density"};

/// Why curvatures of a fit are unknown.
enum class Fit_doubt {
  WITHOUT_FIT, ///< no polynomial belongs to the point
  NOISE,       ///< the error of K is above a half of its size, most of it from noise
  DETAIL       ///< the same, since fits around disagree, or at a scale have too few points
};

/// A reason with the part of the points that have it, from 0 to 1.
struct Doubt_of_points {
  Fit_doubt reason; ///< why the points are doubtful
  double part;      ///< of all points
};

// The library defines these functions.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// An estimate is of the whole error, or of its part that comes from noise, or from detail that a scale leaves out.
enum class Estimate_kind {
  ERROR, ///< column NAME_error
  NOISE, ///< column NAME_noise
  DETAIL ///< column NAME_detail
};

/// A column with estimates for an attribute.
struct Estimate_attribute {
  std::string name;                 ///< as in the header of a file
  Estimate_kind kind;               ///< what it is of
  const Attribute_row<double>* row; ///< the row of the attribute
  bool is_of_splines;               ///< whether splines have it, too, and not fits alone

  /// Returns the column for these points.
  Vertex_attributes::Column column(std::span<const Fitted_structure_3<double>> structures) const;
};

/// Returns all estimates, in the order of the columns of a file.
const std::vector<Estimate_attribute>& estimate_attributes();

/// Returns the selected attributes of points with those structures; `areas` is empty or as in Sampled_vertices.
Vertex_attributes attributes_of_fit(std::span<const Fitted_structure_3<double>> structures,
                                    const Attribute_selection& selection, std::span<const double> areas = {});

/// Returns the facts about fits at points, from the structures there.
Fit_statistics statistics_of_fit(std::span<const Fitted_structure_3<double>> structures);

/// Returns the first one of `affine_quantities` that is known to 50 % at half of the points, or else K.
std::string_view first_known(const Fit_statistics& fit);

/// Returns the reasons why K is unknown, if it is at more points than those where it is known to 50 %: each one that a
/// tenth of these points have. Without affine curvatures only points without a fit count.
std::vector<Doubt_of_points> doubts_of(const Fit_statistics& fit, bool has_affine_curvatures = true);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

} // namespace equiaffine

#endif
