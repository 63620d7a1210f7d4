// SPDX-License-Identifier: GPL-3.0-or-later
// Predicts the duration of a computation from coarser runs, and announces it if it takes minutes.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_EXPECTED_DURATION_H
#define EQUIAFFINE_PROGRAM_SYSTEM_EXPECTED_DURATION_H

#include "system/progress.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

namespace equiaffine {

/// Below this fineness no computation takes long.
inline constexpr double least_fineness_to_measure = 200;

/// Predicts the seconds of a computation at a fineness n, such as the nodes of a grid along an axis. The model is c + a
/// n^2 + b n^3: some work is done once, some per cell near the surface, some per cell (if `is_cubic`). Its coefficients
/// follow from the last three `seconds_of(k)` at k = 16, 32, 64, ..., until a run takes 0.2 s longer than the first
/// one, or k is half of n. From k = 64 on, returns twice the extrapolation by the highest power, without finer runs, if
/// that is below `of_interest`. Returns 0 if the first runs take more than 1 s, so as not to delay the user.
template <class Seconds>
double expected_seconds(double n, bool is_cubic, double of_interest, const Seconds& seconds_of) {
  constexpr double enough = 0.2, too_long = 1, coarsest = 16;
  const auto undisturbed_seconds_of = [&](double k) { // other processes may interrupt one of two runs
    const double seconds = seconds_of(k);
    return seconds < enough || seconds > too_long ? seconds : std::min(seconds, seconds_of(k));
  };
  const double first = undisturbed_seconds_of(coarsest);
  if (first > too_long) return 0;
  double k = 2 * coarsest, now = undisturbed_seconds_of(k), before = first, twice_before = first;
  if (now > too_long) return 0;
  while (4 * k <= n && (k == 2 * coarsest || now - first < enough)) {
    k *= 2;
    twice_before = std::exchange(before, std::exchange(now, undisturbed_seconds_of(k)));
    if (const double bound = 2 * now * std::pow(n / k, is_cubic ? 3 : 2); bound < of_interest) return bound;
  }
  const double step = std::max(now - before, 0.), step_before = std::max(before - twice_before, 0.);
  const double cubic = is_cubic ? std::clamp((step - 4 * step_before) * 16 / 7, 0., step * 8 / 7) : 0,
               square = (step - cubic * 7 / 8) * 4 / 3, once = std::max(now - square - cubic, 0.), factor = n / k;
  return once + (square + cubic * factor) * factor * factor;
}

/// Announces the duration of a stage that calls `run(fineness)`, if it takes minutes, and how to shorten it.
template <class Run>
void announce_duration(const std::string& stage, const std::string& advice, double fineness, bool is_cubic,
                       Progress& progress, const Run& run) {
  constexpr double minute = 60;
  if (fineness < least_fineness_to_measure) return;
  progress.begin(stage + " on coarser grids, to predict the duration");
  double seconds = 0;
  try {
    seconds = expected_seconds(fineness, is_cubic, minute, [&](double coarse) {
      const Stopwatch stopwatch;
      run(coarse);
      return stopwatch.seconds();
    });
  } catch (const std::exception&) {
    return; // the run itself reports errors
  }
  if (seconds >= minute)
    progress.announce(stage + " will take about " + Progress_report::time_text(seconds) + "; " + advice + " is faster");
}

} // namespace equiaffine

#endif
