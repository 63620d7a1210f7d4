// SPDX-License-Identifier: GPL-3.0-or-later
// Predicts how long a computation will take from coarser runs of it, and announces it if that is minutes.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_EXPECTED_DURATION_H
#define EQUIAFFINE_PROGRAM_SYSTEM_EXPECTED_DURATION_H

#include "system/progress.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

namespace equiaffine {

/// Below this fineness nothing takes long.
inline constexpr double least_fineness_to_measure = 200;

/// The seconds that a computation will take at a fineness n, such as the nodes of a grid along an axis. They are about
/// c + a n^2 + b n^3, since some of it is done per cell, some per cell beside the surface, and some once. This follows
/// from the last three of `seconds_of(k)` at k = 16, 32, 64, ..., until that takes some tenths of a second more than at
/// first, or k is half of n. If, from k = 64 on, even twice the time that would follow from the highest power alone is
/// below `of_interest`, that is returned, and no finer k is tried. Returns 0 where 16 or 32 take so long that more of
/// them would keep the user waiting.
template <class Seconds>
double expected_seconds(double n, bool is_cubic, double of_interest, const Seconds& seconds_of) {
  constexpr double enough = 0.2, too_long = 1, coarsest = 16;
  const auto calm_seconds_of = [&](double k) { // something else may have interrupted one of two runs
    const double seconds = seconds_of(k);
    return seconds < enough || seconds > too_long ? seconds : std::min(seconds, seconds_of(k));
  };
  const double first = calm_seconds_of(coarsest);
  if (first > too_long) return 0;
  double k = 2 * coarsest, now = calm_seconds_of(k), before = first, twice_before = first;
  if (now > too_long) return 0;
  while (4 * k <= n && (k == 2 * coarsest || now - first < enough)) {
    k *= 2;
    twice_before = std::exchange(before, std::exchange(now, calm_seconds_of(k)));
    if (const double bound = 2 * now * std::pow(n / k, is_cubic ? 3 : 2); bound < of_interest) return bound;
  }
  const double step = std::max(now - before, 0.), step_before = std::max(before - twice_before, 0.);
  const double cubic = is_cubic ? std::clamp((step - 4 * step_before) * 16 / 7, 0., step * 8 / 7) : 0,
               square = (step - cubic * 7 / 8) * 4 / 3, once = std::max(now - square - cubic, 0.), factor = n / k;
  return once + (square + cubic * factor) * factor * factor;
}

/// Says how long a stage will take that calls `run(fineness)`, if that is minutes, and what would take less.
template <class Run>
void announce_duration(const std::string& stage, const std::string& advice, double fineness, bool is_cubic,
                       Progress& progress, const Run& run) {
  constexpr double minute = 60;
  if (fineness < least_fineness_to_measure) return;
  progress.begin(stage + " on coarser grids, to know how long it will take");
  double seconds = 0;
  try {
    seconds = expected_seconds(fineness, is_cubic, minute, [&](double coarse) {
      const Stopwatch stopwatch;
      run(coarse);
      return stopwatch.seconds();
    });
  } catch (const std::exception&) {
    return; // the run itself will say what is wrong, if it is wrong there, too
  }
  if (seconds >= minute)
    progress.announce(stage + " will take about " + Progress_report::time_text(seconds) + "; " + advice +
                      " takes less");
}

} // namespace equiaffine

#endif
