// SPDX-License-Identifier: GPL-3.0-or-later
// Times of competing implementations, measured alternately so that a busy machine affects all of them equally.
#ifndef EQUIAFFINE_BENCHMARK_RUNNER_H
#define EQUIAFFINE_BENCHMARK_RUNNER_H

#include "measure.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

namespace benchmark_runner {

/// Prevents the compiler from removing the computation of `value`.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r"(&value) : "memory");
}

/// CPU time of this thread in seconds.
inline double thread_clock() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// An implementation. A call processes `items` items, and should take at least 20 microseconds.
struct Contender {
  std::string name;
  std::function<void()> run;
  double items;
  double nanoseconds = 0; ///< per item, the median of all rounds
};

/// Runs every contender once per round.
inline void race(std::vector<Contender>& contenders, int rounds) {
  std::vector<std::vector<double>> times(contenders.size());
  for (int round = 0; round < rounds; ++round)
    for (std::size_t n = 0; n < contenders.size(); ++n) {
      const double start = thread_clock();
      contenders[n].run();
      times[n].push_back(thread_clock() - start);
    }
  for (std::size_t n = 0; n < contenders.size(); ++n) {
    contenders[n].nanoseconds = 1e9 * median(times[n]) / contenders[n].items;
    std::printf("  %-44s %10.1f ns\n", contenders[n].name.c_str(), contenders[n].nanoseconds);
  }
}

inline double time_of(const std::vector<Contender>& contenders, const std::string& name) {
  return std::find_if(contenders.begin(), contenders.end(), [&](const Contender& c) { return c.name == name; })
      ->nanoseconds;
}

} // namespace benchmark_runner

#endif
