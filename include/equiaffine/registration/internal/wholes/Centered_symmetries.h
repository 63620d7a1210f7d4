// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_WHOLES_CENTERED_SYMMETRIES_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_WHOLES_CENTERED_SYMMETRIES_H

#include <equiaffine/registration/Affine_slippage_3.h>
#include <equiaffine/registration/Affine_symmetries_3.h>
#include <equiaffine/registration/internal/wholes/Centered_map.h>

#include <limits>
#include <string>
#include <vector>

namespace equiaffine::internal {

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
