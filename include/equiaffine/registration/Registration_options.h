// SPDX-License-Identifier: GPL-3.0-or-later
// Options of searches for maps between surfaces and for symmetries, and advice on which of them may find more.
#ifndef EQUIAFFINE_REGISTRATION_REGISTRATION_OPTIONS_H
#define EQUIAFFINE_REGISTRATION_REGISTRATION_OPTIONS_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/fit/Fit_options.h>

#include <cstddef>
#include <optional>

namespace equiaffine {

/// The class of maps to search.
enum class Map_kind {
  AFFINE,     ///< p -> A p + t with an invertible matrix A: 12 numbers
  EQUIAFFINE, ///< |det A| = 1: 11 numbers
  SIMILARITY, ///< A is a multiple of an orthogonal matrix: 7 numbers
  RIGID       ///< A is orthogonal: 6 numbers
};

/// Whether maps of the kind preserve volumes, up to their sign.
constexpr bool keeps_volume(Map_kind kind) { return kind == Map_kind::EQUIAFFINE || kind == Map_kind::RIGID; }
/// Whether maps of the kind preserve angles.
constexpr bool keeps_angles(Map_kind kind) { return kind == Map_kind::SIMILARITY || kind == Map_kind::RIGID; }

} // namespace equiaffine

namespace equiaffine::internal {

/// Checks a distance relative to the size of a surface.
inline void check_tolerance(const std::optional<double>& tolerance) {
  check_field(!tolerance || (*tolerance > 0 && *tolerance < 0.1), "tolerance", tolerance.value_or(0),
              "is not between 0 and 0.1", "give a fraction of the size of the surface, such as 1e-3, or leave it out");
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Options of register_surfaces().
struct Registration_options {
  Map_kind kind = Map_kind::AFFINE; ///< kind of the maps to search
  bool reflections = true;          ///< whether maps may be orientation-reversing
  std::size_t number_of_maps = 1;   ///< maximum number of maps with evidence; above 1 the search continues after the
                                    ///< first
  double min_overlap = 0.05; ///< minimum fraction of the points of one of the surfaces that must lie on the other
  /// The largest rms distance of moved points from the other surface, relative to the size of the target; below 0.1.
  /// By default it is what noise and facets explain.
  std::optional<double> tolerance = {};
  /// Options of fits to the vertices of meshes, or to points. With a scale both surfaces are compared at it;
  /// otherwise several scales are tried.
  Fit_options fit = {};

  /// \throw Input_error if a value is invalid; the error names the field
  void check() const {
    using internal::check_field;
    check_field(number_of_maps > 0, "number_of_maps", double(number_of_maps), "is not above 0", "give 1 or more");
    check_field(min_overlap >= 0 && min_overlap <= 1, "min_overlap", min_overlap, "is not between 0 and 1",
                "give a fraction of the points, such as 0.05");
    internal::check_tolerance(tolerance);
    internal::check_member("fit", fit);
  }
};

/// Options of affine_symmetries().
struct Symmetry_options {
  Map_kind kind = Map_kind::AFFINE; ///< kind of the maps to search
  bool reflections = true;          ///< whether maps may be orientation-reversing
  /// The largest rms distance of moved points from the surface, relative to its size; below 0.1. By default 1e-8 for
  /// a function, 1e-5 for a spline through samples, and 1e-3 for a fit, which describe the surface only within their
  /// errors. For a mesh the default is the first group of symmetries within 0.01.
  std::optional<double> tolerance = {};
  bool complete = false; ///< whether to search all rotations, as for a mesh, even if the frames of a function already
                         ///< decide
  Fit_options fit = {};  ///< options of fits to points, or to the vertices of a mesh that does not bound a solid

  /// \throw Input_error if a value is invalid; the error names the field
  void check() const {
    internal::check_tolerance(tolerance);
    internal::check_member("fit", fit);
  }
};

/// Other options or other data that may find a map, or more symmetries.
enum class Registration_advice {
  SIMILARITIES_OF_FRAMES,     ///< the kind SIMILARITY: its frames require fewer derivatives, and exist on quadrics, too
  SIMILARITIES_OF_OTHER_SIZE, ///< the kind SIMILARITY: it allows different sizes
  SIMILARITIES_OF_TRIANGLES,  ///< the kind SIMILARITY: it requires no curvature
  ALL_MAPS,                   ///< the kind AFFINE
  RIGID_MAPS,                 ///< the kind RIGID: it requires no solid
  REFLECTIONS,                ///< orientation-reversing maps
  SAME_SCALE,                 ///< the same scale for both fits
  LARGER_SAME_SCALE,          ///< a larger scale for both fits
  A_SCALE,                    ///< a scale for the only fit
  LARGER_SCALE,               ///< a larger scale for the only fit
  FIT_OF_MESH,                ///< a fit instead of distances to facets, which have no affine curvature
  SMOOTHING,                  ///< smoothed samples
  LARGER_TOLERANCE,           ///< a larger tolerance
  OTHER_TOLERANCE,            ///< a different tolerance
  SMALLER_OVERLAP,            ///< a smaller min_overlap
  MORE_IN_COMMON              ///< surfaces that have more in common
};

} // namespace equiaffine

#endif
