// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_PROGRESS_REPORT_H
#define EQUIAFFINE_PROGRAM_SYSTEM_PROGRESS_REPORT_H

#include <chrono>
#include <cstddef>
#include <ostream>
#include <string>

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
  bool is_shown_ = false, is_forewarned_ = false;
};

} // namespace equiaffine

#endif
