// SPDX-License-Identifier: GPL-3.0-or-later
// Options of fits to the vertices of a mesh or to points, and of remeshing on fits.
#ifndef EQUIAFFINE_FIT_FIT_OPTIONS_H
#define EQUIAFFINE_FIT_FIT_OPTIONS_H

#include <equiaffine/base/Input_error.h>

#include <cmath>
#include <optional>

namespace equiaffine {

/// Whether the normals that come with points agree about the side of the surface.
enum class Normal_orientation {
  ORIENTED,  ///< all normals point to the same side of the surface
  UNORIENTED ///< each normal is correct up to its sign
};

/// Options of fits. Options without a value are chosen from the data.
struct Fit_options {
  /// The length that separates shape from detail: curvatures are those of polynomials fitted within about this
  /// radius. 0 always gives the curvatures of the surface itself. By default they are those of the surface where the
  /// data resolve it, else those at the smallest scale, up to an eighth of the size, at which half of the vertices
  /// are known to 20 %.
  std::optional<double> scale = {};
  std::optional<double> noise = {}; ///< standard deviation of the points from the surface, a length
  std::optional<int> degree = {};   ///< degree of the polynomials: 4, 5, 6, 8 or 10
  /// Edges of a mesh that bend by more than this angle, in degrees from 0 to 180, are creases if they form chains.
  /// Polynomials do not extend across creases, and remeshing keeps them. 180 for no creases.
  double feature_angle = 60;
  Normal_orientation normal_orientation = Normal_orientation::ORIENTED; ///< of the normals that come with points

  /// \throw Input_error if a value is invalid; the error names the field
  void check() const {
    using internal::check_field;
    check_field(!scale || (std::isfinite(*scale) && *scale >= 0), "scale", scale.value_or(0), "is not a length",
                "give a length above 0, or 0 for the surface's own curvatures");
    check_field(!noise || (std::isfinite(*noise) && *noise >= 0), "noise", noise.value_or(0),
                "is not a standard deviation", "give a length of 0 or more, or leave it out");
    const int n = degree.value_or(4);
    check_field(n == 4 || n == 5 || n == 6 || n == 8 || n == 10, "degree", n, "is not one of 4, 5, 6, 8 and 10",
                "give one of them, or leave it out");
    check_field(feature_angle >= 0 && feature_angle <= 180, "feature_angle", feature_angle,
                "is not between 0 and 180 degrees", "give an angle such as 60");
  }
};

/// Options of remesh_on_fit().
struct Remesh_options {
  std::optional<double> edge_length = {}; ///< target length of the edges; by default the mean of the given mesh
  unsigned iterations = 3;                ///< rounds of splits, collapses, flips and relaxation
  double feature_angle = 60;              ///< in degrees, as in Fit_options: sharper edges are kept

  /// \throw Input_error if a value is invalid; the error names the field
  void check() const {
    using internal::check_field;
    check_field(!edge_length || (std::isfinite(*edge_length) && *edge_length > 0), "edge_length",
                edge_length.value_or(0), "is not a length", "give a length above 0, or leave it out");
    check_field(feature_angle >= 0 && feature_angle <= 180, "feature_angle", feature_angle,
                "is not between 0 and 180 degrees", "give an angle such as 60");
  }
};

} // namespace equiaffine

#endif
