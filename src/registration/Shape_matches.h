// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_SHAPE_MATCHES_H
#define EQUIAFFINE_SRC_REGISTRATION_SHAPE_MATCHES_H

#include "registration/Affine_map_3.h"
#include <equiaffine/registration/Affine_slippage_3.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace equiaffine::internal {

/// A map of one mesh onto another one, or of parts of them, with its evidence.
struct Shape_match {
  Affine_map_3 map;
  double rms; ///< of the distances of points that lie on the other surface, in the unit of the target
  std::array<double, 2> inliers; ///< the parts of the area of the source, and of the target, that lie on the other one
  double log10_false_alarms;     ///< of the number of maps as good as this one that chance would make
  std::array<double, 2> contradictions; ///< the parts of points off the other surface although that does not end there
};

/// The maps between meshes that a search found.
struct Shape_matches {
  std::vector<Shape_match> maps = {}; ///< the best first
  std::size_t hypotheses = 0;         ///< the number of maps that were tried
  double size = 0;                    ///< of the target
  Affine_slippage_3 slippage = {};    ///< of the source; if it slips, each map is one of a continuous family
  std::string reason = {};            ///< why none of the hypotheses is accepted
};

} // namespace equiaffine::internal

#endif
