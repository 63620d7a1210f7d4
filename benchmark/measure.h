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

/// Wall time, for programs with several threads. Nothing else should run.
inline double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}
/// CPU time of this process, for programs with one thread. Other processes can run.
inline double processor_clock() { return double(std::clock()) / CLOCKS_PER_SEC; }

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// Times of a and b, and their ratio.
struct Comparison {
  double ratio, a, b;
};

/// Times a and b alternately, so that disturbances affect both. The first run of each is not counted.
inline std::vector<Comparison> neighboring_runs(Clock clock, int runs, const std::function<void()>& a,
                                                const std::function<void()>& b) {
  const auto seconds = [&](const std::function<void()>& f) {
    const double begin = clock();
    f();
    return clock() - begin;
  };
  a();
  b();
  std::vector<Comparison> pairs;
  for (int n = 0; n < runs; ++n) {
    const double time_a = seconds(a), time_b = seconds(b);
    pairs.push_back({time_a / time_b, time_a, time_b});
  }
  return pairs;
}

/// Compares a and b by medians over consecutive runs.
inline Comparison compare(Clock clock, int runs, const std::function<void()>& a, const std::function<void()>& b) {
  const auto pairs = neighboring_runs(clock, runs, a, b);
  const auto median_of = [&](double Comparison::*member) {
    std::vector<double> numbers;
    for (const Comparison& pair : pairs) numbers.push_back(pair.*member);
    return median(numbers);
  };
  return {median_of(&Comparison::ratio), median_of(&Comparison::a), median_of(&Comparison::b)};
}

/// Compares the wall times of one thread and of several by the pair of consecutive runs with the smallest total time.
/// Other processes use a core of the second thread, so most pairs underestimate the speedup.
inline Comparison compare_threads(int runs, const std::function<void()>& one, const std::function<void()>& several) {
  const auto pairs = neighboring_runs(wall_clock, runs, one, several);
  return *std::min_element(pairs.begin(), pairs.end(),
                           [](const Comparison& p, const Comparison& q) { return p.a + p.b < q.a + q.b; });
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

/// CPU time of a shell command and its child processes in seconds; NaN if it fails.
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

/// Prints a line for a figure: name, value, unit and target.
inline void figure(const std::string& name, double value, const char* unit, const std::string& target) {
  std::printf("figure %s %.4g %s target %s\n", name.c_str(), value, unit, target.c_str());
  std::fflush(stdout);
}

#endif
