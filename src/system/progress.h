// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_SYSTEM_PROGRESS_H
#define EQUIAFFINE_SRC_SYSTEM_PROGRESS_H

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

namespace equiaffine {

/// A line on a terminal that says what a long computation is doing. It appears after a second and is wiped away at the
/// end; where there is no terminal it never appears. Warnings follow it.
class Progress {
public:
  using Clock = std::chrono::steady_clock;

  Progress(std::ostream& terminal, bool is_terminal, Clock::duration patience = std::chrono::seconds(1));
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begins the next stage, of `steps` steps; 0 if their number is not known.
  void begin(const std::string& stage, std::size_t steps = 0);

  /// Counts steps of the stage. Any thread may call it.
  void advance(std::size_t steps = 1) { done_.fetch_add(steps, std::memory_order_relaxed); }

  /// Wipes the line away; nothing is shown any more.
  void end();

  /// Ends and writes a line about what the user did not expect, whether there is a terminal or not.
  void warn(const std::string& text);

private:
  void show_until_ended();
  std::string line() const;

  std::ostream& terminal_;
  const Clock::time_point start_ = Clock::now();
  const Clock::duration patience_;
  mutable std::mutex mutex_; // guards the members from here to the thread
  std::condition_variable ended_;
  bool is_ended_ = false;
  std::string stage_;
  std::size_t steps_ = 0;
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
