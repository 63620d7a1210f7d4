// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SYSTEM_FOREWARN_H
#define EQUIAFFINE_SRC_SYSTEM_FOREWARN_H

#include "system/progress.h"

#include <algorithm>
#include <string>

namespace equiaffine {

/// Below this fineness nothing takes long.
inline constexpr double least_fineness_to_forewarn = 200;

/// The seconds that a computation will take at a fineness n, such as the nodes of a grid along an axis. They are about
/// c + a n^2 + b n^3, since some of it is done per cell, some per cell beside the surface, and some once. This follows from
/// `seconds_of(k)` at three smaller k, of which the greatest takes some tenths of a second, or is about a quarter of n.
template <class Seconds>
double expected_seconds(double n, const Seconds& seconds_of) {
  constexpr double enough = 0.2, coarsest = 16;
  const double once = seconds_of(coarsest);
  double before = 0;
  for (double k = 2 * coarsest;; k *= 2) {
    const double now = std::max(seconds_of(k) - once, 0.);
    if (now >= enough || 8 * k > n) {
      const double cubic = std::clamp(2 * (now - 4 * before), 0., now), square = now - cubic, factor = n / k;
      return once + (square + cubic * factor) * factor * factor;
    }
    before = now;
  }
}

/// Says how long a stage will take that calls `run(fineness)`, if that is minutes, and what would take less.
template <class Run>
void forewarn(const std::string& stage, const std::string& advice, double fineness, Progress& progress,
              const Run& run) {
  constexpr double minute = 60;
  if (fineness < least_fineness_to_forewarn) return;
  progress.begin("measuring how long " + stage + " will take");
  const double seconds = expected_seconds(fineness, [&](double coarse) {
    const Stopwatch stopwatch;
    run(coarse);
    return stopwatch.seconds();
  });
  if (seconds >= minute)
    progress.announce(stage + " will take about " + Progress_report::time_text(seconds) + "; " + advice +
                      " takes less");
}

} // namespace equiaffine

#endif
