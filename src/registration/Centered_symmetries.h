// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_CENTERED_SYMMETRIES_H
#define EQUIAFFINE_SRC_REGISTRATION_CENTERED_SYMMETRIES_H

#include "registration/Centered_map.h"
#include <equiaffine/registration/Affine_slippage_3.h>
#include <equiaffine/registration/Affine_symmetries_3.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace equiaffine::internal {

/// Thresholds of distances, parts of the size.
struct Symmetry_thresholds {
  double exact = 0, turn = 0, approximate = 0.01, none = 0.03;

  /// A symmetry is exact if it holds to rounding at every point. Triangles that stand for a smooth surface turn to within
  /// their own error. Thin surfaces have less than their thickness allows. With a `tolerance` above 0, maps up to it are
  /// sought, and a surface turns to within it.
  Symmetry_thresholds(const Centered_surface_3& surface, double tolerance) {
    const double thickness = surface.thickness(), facet_error = surface.samples.facet_error;
    exact = exact_distance(surface.rounding);
    approximate = std::min(approximate, 0.03 * thickness);
    const double facets = exact + std::min(3 * facet_error, approximate); // points of facets are off other facets
    turn = tolerance > 0 ? std::max(exact, tolerance) : facets;
    none = std::max({0.03 * thickness, 1.2 * approximate, 1.2 * tolerance});
  }
};

/// A finite group of maps, each of which moves the surface onto itself to within an rms distance.
struct Symmetry_level {
  std::vector<Centered_map> maps; ///< in the coordinates of the surface, the identity first, then by rms
  double rms = 0;                 ///< the largest of a map, a part of the size, in the proportions of the surface
  double greatest = 0;            ///< the largest distance of a moved point from the surface, there
  double searched_rms = 0;        ///< the largest of a map, in the proportions in which maps are sought
  double next_rms =
      std::numeric_limits<double>::infinity(); ///< the least of a map that is not in the group, a lower bound
};

/// The symmetries of a whole surface.
struct Centered_symmetries {
  Symmetry_verdict verdict = Symmetry_verdict::UNDECIDED;
  std::string reason = {};                 ///< of an undecided case
  std::vector<Symmetry_level> levels = {}; ///< groups, each of which holds the one before, with growing rms
  Affine_slippage_3 continuous = {};       ///< the rotations of the continuous group: none, 1 or 3
  double complete_to = 0;                  ///< all maps with a smaller rms were tried, in the surface's proportions
  double least_rms = 0;                    ///< the least of a map beside the identity, a part of the size
};

} // namespace equiaffine::internal

#endif
