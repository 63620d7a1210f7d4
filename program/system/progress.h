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

/// What is said of a long computation, and when: on a terminal a line that is written again and again and wiped away at
/// the end, elsewhere a line every ten seconds, and one as soon as it is known that a stage will take minutes. Whoever
/// calls it says what time it is.
class Progress_report {
public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  static constexpr Clock::duration time_between_lines = std::chrono::seconds(10);

  Progress_report(std::ostream& stream, bool is_terminal, Time start)
      : stream_(stream), is_terminal_(is_terminal), start_(start), begin_of_stage_(start),
        time_of_line_(start + time_between_lines) {}

  /// Begins the next stage, of `steps` steps; 0 if their number is not known.
  void begin(const std::string& stage, std::size_t steps, Time now);

  /// Writes what is to be said at that time, when so many steps of the stage are done.
  void show(std::size_t done, Time now);

  /// Wipes the line of a terminal away.
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
  Time begin_of_stage_, time_of_line_; ///< the latter is that of the next line where there is no terminal
  bool is_shown_ = false, is_announced_ = false;
};

/// Says what a long computation is doing. On a terminal a line appears after a second and is wiped away at the end;
/// where there is no terminal a line is written every ten seconds. Warnings follow it.
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
