// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SOURCE_SPLINE_STATISTICS_H
#define EQUIAFFINE_SRC_SOURCE_SPLINE_STATISTICS_H

#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Spline_scheme.h>

#include <cstddef>

namespace equiaffine {

/// The facts about samples, and about the spline that was made from them, that the program reports.
struct Spline_statistics {
  int degree = 0;
  Spline_scheme scheme = Spline_scheme::QUASI_INTERPOLATION;
  double smoothing = 0;
  Sample_noise noise = {};
  std::size_t least_nodes = 0; ///< along the axis that has the fewest
};

} // namespace equiaffine

#endif
