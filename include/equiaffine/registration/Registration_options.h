// SPDX-License-Identifier: GPL-3.0-or-later
// The options of searches for maps between surfaces, and for symmetries, and which of them may find more.
#ifndef EQUIAFFINE_REGISTRATION_REGISTRATION_OPTIONS_H
#define EQUIAFFINE_REGISTRATION_REGISTRATION_OPTIONS_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/fit/Fit_options.h>

#include <cstddef>
#include <optional>

namespace equiaffine {

/// The maps of space among which one is sought that moves a surface onto another.
enum class Map_kind {
  AFFINE,     ///< p -> A p + t with an invertible matrix A: 12 numbers
  EQUIAFFINE, ///< those with |det A| = 1: 11 numbers
  SIMILARITY, ///< those where A is a multiple of an orthogonal matrix: 7 numbers
  RIGID       ///< those where A is orthogonal: 6 numbers
};

/// Whether maps of the kind keep volumes, up to their sign.
constexpr bool keeps_volume(Map_kind kind) { return kind == Map_kind::EQUIAFFINE || kind == Map_kind::RIGID; }
/// Whether maps of the kind keep angles.
constexpr bool keeps_angles(Map_kind kind) { return kind == Map_kind::SIMILARITY || kind == Map_kind::RIGID; }

} // namespace equiaffine

namespace equiaffine::internal {

/// Checks a distance beside the size of a surface.
inline void check_tolerance(const std::optional<double>& tolerance) {
  check_field(!tolerance || (*tolerance > 0 && *tolerance < 0.1), "tolerance", tolerance.value_or(0),
              "is not between 0 and 0.1", "give a part of the size of the surface, such as 1e-3, or leave it out");
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Options of register_surfaces().
struct Registration_options {
  Map_kind kind = Map_kind::AFFINE; ///< of the maps that are sought
  bool reflections = true;          ///< whether maps may turn left into right
  std::size_t number_of_maps = 1;   ///< the greatest number of maps with evidence; with more than 1 the search goes on
  double min_overlap = 0.05; ///< the part of the points of one of the surfaces, at least, that is to lie on the other
  /// The largest rms distance to which a map may move points from the other surface, a part of the size of the target,
  /// below 0.1. By default what noise and facets explain.
  std::optional<double> tolerance = {};
  /// Of the vertices of meshes, or of points. With a scale both surfaces are compared at it; else scales are tried.
  Fit_options fit = {};

  /// \throw Input_error for a value that makes no sense, about the field
  void check() const {
    using internal::check_field;
    check_field(number_of_maps > 0, "number_of_maps", double(number_of_maps), "is not above 0", "give 1 or more");
    check_field(min_overlap >= 0 && min_overlap <= 1, "min_overlap", min_overlap, "is not a part of a surface",
                "give a number from 0 to 1, such as 0.05");
    internal::check_tolerance(tolerance);
    internal::check_member("fit", fit);
  }
};

/// Options of affine_symmetries().
struct Symmetry_options {
  Map_kind kind = Map_kind::AFFINE; ///< of the maps that are sought
  bool reflections = true;          ///< whether maps may turn left into right
  /// The largest rms distance to which a map may move points from the surface, a part of its size, below 0.1. By
  /// default 1e-8 for a function, 1e-5 for a spline through samples and 1e-3 for a fit, which know the surface to
  /// within their errors only; a mesh has the first group of symmetries within 0.01.
  std::optional<double> tolerance = {};
  bool complete = false; ///< whether all rotations are searched, as for a mesh, where the frames of a function decide
  Fit_options fit = {};  ///< of the vertices of a mesh that bounds no solid, or of points

  /// \throw Input_error for a value that makes no sense, about the field
  void check() const {
    internal::check_tolerance(tolerance);
    internal::check_member("fit", fit);
  }
};

/// What may find a map, or more symmetries, where none were found: other options, or other data.
enum class Registration_advice {
  SIMILARITIES_OF_FRAMES,     ///< the kind SIMILARITY: its frames need fewer derivatives, and exist on quadrics, too
  SIMILARITIES_OF_OTHER_SIZE, ///< the kind SIMILARITY: it allows other sizes
  SIMILARITIES_OF_TRIANGLES,  ///< the kind SIMILARITY: it needs no curvature
  ALL_MAPS,                   ///< the kind AFFINE
  RIGID_MAPS,                 ///< the kind RIGID: it needs no solid
  REFLECTIONS,                ///< maps that turn left into right
  SAME_SCALE,                 ///< the same scale for both fits
  LARGER_SAME_SCALE,          ///< a larger scale for both fits
  A_SCALE,                    ///< a scale for the only fit
  LARGER_SCALE,               ///< a larger scale for the only fit
  FIT_OF_MESH,                ///< a fit in place of distances to facets, which have no affine curvature
  SMOOTHING,                  ///< smoothed samples
  LARGER_TOLERANCE,           ///< a larger tolerance
  OTHER_TOLERANCE,            ///< another tolerance
  SMALLER_OVERLAP,            ///< a smaller min_overlap
  MORE_IN_COMMON              ///< surfaces that have more in common
};

} // namespace equiaffine

#endif
