// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_PROGRESS_H
#define EQUIAFFINE_PROGRAM_SYSTEM_PROGRESS_H

#include "system/Progress_report.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

namespace equiaffine {

/// Says what a long computation is doing. On a terminal a line appears after a second and is wiped away at the end; where
/// there is no terminal a line is written every ten seconds. Warnings follow it.
class Progress {
public:
  using Clock = Progress_report::Clock;

  Progress(std::ostream& stream, bool is_terminal, Clock::duration patience = std::chrono::seconds(1));
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begins the next stage, of `steps` steps; 0 if their number is not known.
  void begin(const std::string& stage, std::size_t steps = 0);

  /// Counts steps of the stage. Any thread may call it.
  void advance(std::size_t steps = 1) { done_.fetch_add(steps, std::memory_order_relaxed); }

  /// Writes a line about what comes next, whether there is a terminal or not.
  void announce(const std::string& text);

  /// Wipes the line away; nothing is shown any more.
  void end();

  /// Ends and writes a line about what the user did not expect, whether there is a terminal or not.
  void warn(const std::string& text);

private:
  void show(Clock::duration patience);

  std::ostream& stream_;
  std::mutex mutex_; // guards the report and whether the work is ended
  std::condition_variable ended_;
  Progress_report report_;
  bool is_ended_ = false;
  std::atomic<std::size_t> done_ = 0;
  std::thread thread_;
};

/// Measures the seconds since it was made.
class Stopwatch {
public:
  double seconds() const { return std::chrono::duration<double>(Progress::Clock::now() - start_).count(); }

private:
  const Progress::Clock::time_point start_ = Progress::Clock::now();
};

} // namespace equiaffine

#endif
