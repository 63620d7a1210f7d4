// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BENCHMARK_MEASURE_H
#define EQUIAFFINE_BENCHMARK_MEASURE_H

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <malloc.h>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

using Clock = double (*)(); // seconds

/// For programs with several threads: nothing else should run.
inline double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
/// For programs with one thread: what this process has computed, whatever else runs.
inline double processor_clock() { return double(std::clock()) / CLOCKS_PER_SEC; }

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// Medians of the times of a and b, and of their ratio.
struct Comparison {
  double ratio, a, b;
};

/// Runs alternate, so that what disturbs one disturbs the other; the first of each is not counted.
inline Comparison compare(Clock clock, int runs, const std::function<void()>& a, const std::function<void()>& b) {
  const auto seconds = [&](const std::function<void()>& f) {
    const double begin = clock();
    f();
    return clock() - begin;
  };
  a();
  b();
  std::vector<double> ratios, times_a, times_b;
  for (int n = 0; n < runs; ++n) {
    times_a.push_back(seconds(a));
    times_b.push_back(seconds(b));
    ratios.push_back(times_a.back() / times_b.back());
  }
  return {median(ratios), median(times_a), median(times_b)};
}

/// Peak memory of a child of this process that runs f, in MB.
inline double peak_megabytes(const std::function<void()>& f) {
  malloc_trim(0); // or the child would use what this process has freed
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    f();
    _exit(0);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  return double(usage.ru_maxrss) / 1024;
}

/// Processor seconds of a command of the shell and of what it starts; NaN if it fails.
inline double processor_seconds_of(const std::string& command) {
  const auto seconds_of_children = [] {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  };
  const double begin = seconds_of_children();
  if (std::system(command.c_str()) != 0) return std::numeric_limits<double>::quiet_NaN();
  return seconds_of_children() - begin;
}

/// One line per figure: its name, value and unit, and the target whether met or not.
inline void figure(const std::string& name, double value, const char* unit, const std::string& target) {
  std::printf("figure %s %.4g %s target %s\n", name.c_str(), value, unit, target.c_str());
  std::fflush(stdout);
}

#endif
