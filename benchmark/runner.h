// SPDX-License-Identifier: GPL-3.0-or-later
// Times of competing ways to do one thing, taken in turn so that a busy machine disturbs all of them alike, and the
// lines in which a benchmark reports.
#ifndef EQUIAFFINE_BENCHMARK_RUNNER_H
#define EQUIAFFINE_BENCHMARK_RUNNER_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace benchmark_runner {

/// Makes the compiler believe that `value` is read.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

/// One way: a call does `items` things, so often that it takes about a millisecond.
struct Contender {
  std::string name;
  std::function<void()> run;
  double items;
  double nanoseconds = std::numeric_limits<double>::infinity(); ///< per item, the best of all rounds
};

/// Runs every contender once per round and keeps its best time.
inline void race(std::vector<Contender>& contenders, int rounds = 25) {
  using Clock = std::chrono::steady_clock;
  for (int round = 0; round < rounds; ++round)
    for (Contender& c : contenders) {
      const auto start = Clock::now();
      c.run();
      const std::chrono::duration<double, std::nano> time = Clock::now() - start;
      c.nanoseconds = std::min(c.nanoseconds, time.count() / c.items);
    }
  for (const Contender& c : contenders) std::printf("  %-44s %10.1f ns\n", c.name.c_str(), c.nanoseconds);
}

inline double time_of(const std::vector<Contender>& contenders, const std::string& name) {
  return std::find_if(contenders.begin(), contenders.end(), [&](const Contender& c) { return c.name == name; })
      ->nanoseconds;
}

inline void figure_at_least(const char* name, double value, const char* unit, double target) {
  std::printf("figure %s %.4g %s target >=%g\n", name, value, unit, target);
}
inline void figure_at_most(const char* name, double value, const char* unit, double target) {
  std::printf("figure %s %.4g %s target <=%g\n", name, value, unit, target);
}

} // namespace benchmark_runner

#endif
