// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SOURCE_FIT_STATISTICS_H
#define EQUIAFFINE_SRC_SOURCE_FIT_STATISTICS_H

#include <equiaffine/fit/Fitted_structure_3.h>

#include <array>
#include <span>

namespace equiaffine {

/// The facts about a fit, at the vertices of a mesh or at points, that the program reports.
struct Fit_statistics {
  std::array<double, 3> scales{}; ///< the least, median and greatest radius; NaN if there is no fit
  double noise = 0;               ///< the median of the deviations of the data; NaN if there is no fit
  std::array<double, 3> known{};  ///< the parts of the points whose error is below each of `error_bounds`

  /// The parts of the points that have no fit, and of those that have an error above the last bound: most of it from
  /// noise, or most of it from what the fits around disagree on.
  double without_fit = 0, doubtful_by_noise = 0, doubtful_by_detail = 0;
};

/// Bounds for the estimated error of K as a part of |K| + H^2.
inline constexpr std::array<double, 3> error_bounds = {0.1, 0.2, 0.5};

Fit_statistics statistics_of(std::span<const Fitted_structure_3<double>> structures);

} // namespace equiaffine

#endif
