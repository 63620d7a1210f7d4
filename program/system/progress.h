// SPDX-License-Identifier: GPL-3.0-or-later
// Shows the progress of long computations and measures their time.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_PROGRESS_H
#define EQUIAFFINE_PROGRAM_SYSTEM_PROGRESS_H

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

namespace equiaffine {

/// Writes the progress of a long computation: on a terminal a line that is updated, and erased at the end; otherwise a
/// line every ten seconds, and one as soon as a stage is predicted to take a minute or more. The caller passes the
/// time.
class Progress_report {
public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  static constexpr Clock::duration time_between_lines = std::chrono::seconds(10);

  Progress_report(std::ostream& stream, bool is_terminal, Time start)
      : stream_(stream), is_terminal_(is_terminal), start_(start), begin_of_stage_(start),
        time_of_line_(start + time_between_lines) {}

  /// Begins the next stage, of `steps` steps; 0 if unknown.
  void begin(const std::string& stage, std::size_t steps, Time now);

  /// Writes the progress at this time, if due, when `done` steps of the stage are done.
  void show(std::size_t done, Time now);

  /// Erases the line on a terminal.
  void wipe();

  /// Returns the time in two units at most, such as "3 min 20 s".
  static std::string time_text(double seconds);

private:
  std::string bar(double fraction, Time now) const;
  std::string percentage(double fraction) const;
  std::string times(double fraction, Time now) const;
  bool is_known_to_be_long(double fraction, Time now) const;

  std::ostream& stream_;
  const bool is_terminal_;
  const Time start_;
  std::string stage_ = "starting";
  std::size_t steps_ = 0;
  Time begin_of_stage_, time_of_line_; ///< the latter is that of the next line without a terminal
  bool is_shown_ = false, is_announced_ = false;
};

/// Shows the progress of a computation from a thread of its own, if it takes longer than `patience`; see
/// Progress_report. Warnings follow it.
class Progress {
public:
  using Clock = Progress_report::Clock;

  Progress(std::ostream& stream, bool is_terminal, Clock::duration patience = std::chrono::seconds(1));
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begins the next stage, of `steps` steps; 0 if unknown.
  void begin(const std::string& stage, std::size_t steps = 0);

  /// Counts steps of the stage. Thread-safe.
  void advance(std::size_t steps = 1) { done_.fetch_add(steps, std::memory_order_relaxed); }

  /// Writes a line, with or without a terminal.
  void announce(const std::string& text);

  /// Erases the line, and shows nothing more.
  void end();

  /// Ends, and writes a warning, with or without a terminal.
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

/// Measures the seconds since its construction.
class Stopwatch {
public:
  double seconds() const { return std::chrono::duration<double>(Progress::Clock::now() - start_).count(); }

private:
  const Progress::Clock::time_point start_ = Progress::Clock::now();
};

} // namespace equiaffine

#endif
