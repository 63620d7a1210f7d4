// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_SPLINE_STATISTICS_H
#define EQUIAFFINE_PROGRAM_SOURCE_SPLINE_STATISTICS_H

#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Spline_scheme.h>

#include <cstddef>
#include <optional>

namespace equiaffine {

/// The facts about samples, and about the spline that was made from them, that the program reports.
struct Spline_statistics {
  int degree = 0;
  Spline_scheme scheme = Spline_scheme::QUASI_INTERPOLATION;
  double smoothing = 0;
  bool is_smoothing_chosen = false; ///< by the noise, and not given
  Sample_noise noise = {};
  std::size_t least_nodes = 0;                     ///< along the axis that has the fewest
  std::optional<std::size_t> distinct_values = {}; ///< the number of those of the samples, if they are at most 256
};

} // namespace equiaffine

#endif
