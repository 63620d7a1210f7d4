// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/progress.h"

#include <equiaffine/base/Input_error.h>

#include <algorithm>

namespace equiaffine {

namespace {

constexpr const char* wipe_line = "\r\x1b[K"; // carriage return, and erase the line

double seconds(Progress_report::Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

} // namespace

std::string Progress_report::time_text(double seconds) {
  constexpr double most = 3.6e12; // a billion hours
  const auto all = static_cast<long long>(std::min(seconds, most));
  const auto text = [](long long number, const char* unit) { return std::to_string(number) + unit; };
  if (all < 60) return text(all, " s");
  if (all < 3600) return text(all / 60, " min ") + text(all % 60, " s");
  return text(all / 3600, " h ") + text(all / 60 % 60, " min");
}

void Progress_report::begin(const std::string& stage, std::size_t steps, Time now) {
  stage_ = stage;
  steps_ = steps;
  begin_of_stage_ = now;
  is_announced_ = false;
}

void Progress_report::show(std::size_t done, Time now) {
  const double fraction = steps_ > 0 ? std::min(double(done) / double(steps_), 1.) : 0;
  if (is_terminal_) {
    std::string percent = percentage(fraction);
    percent.insert(0, 5 - percent.size(), ' ');
    stream_ << wipe_line << '[' << bar(fraction, now) << "] " << percent << "  " << stage_ << times(fraction, now)
            << std::flush;
    is_shown_ = true;
  } else if (now >= time_of_line_ || (!is_announced_ && is_known_to_be_long(fraction, now))) {
    is_announced_ = true;
    const std::string percent = percentage(fraction);
    stream_ << "equiaffine: progress: " << stage_ << (percent.empty() ? "" : ", ") << percent << times(fraction, now)
            << std::endl;
    time_of_line_ = now + time_between_lines;
  }
}

/// Whether the stage is predicted to take a minute or more, after a second and 1 % of it.
bool Progress_report::is_known_to_be_long(double fraction, Time now) const {
  const double passed = seconds(now - begin_of_stage_);
  return passed >= 1 && fraction >= 0.01 && passed >= 60 * fraction;
}

void Progress_report::wipe() {
  if (is_shown_) stream_ << wipe_line << std::flush;
  is_shown_ = false;
}

/// A bar; a moving mark if the number of steps is unknown.
std::string Progress_report::bar(double fraction, Time now) const {
  constexpr std::size_t width = 24;
  std::string text(width, '.');
  if (steps_ > 0) {
    std::fill_n(text.begin(), std::size_t(fraction * double(width)), '#');
  } else {
    const std::size_t place = std::size_t(10 * seconds(now - start_)) % (2 * width - 2);
    text[place < width ? place : 2 * width - 2 - place] = '#';
  }
  return text;
}

std::string Progress_report::percentage(double fraction) const {
  return steps_ > 0 ? std::to_string(int(100 * fraction)) + " %" : "";
}

/// The time since the start, and the remaining time of the stage at its rate so far.
std::string Progress_report::times(double fraction, Time now) const {
  const std::string text = ", " + time_text(seconds(now - start_));
  if (!(fraction > 0)) return text;
  return text + ", about " + time_text(seconds(now - begin_of_stage_) * (1 - fraction) / fraction) + " left";
}

Progress::Progress(std::ostream& stream, bool is_terminal, Clock::duration patience)
    : stream_(stream), report_(stream, is_terminal, Clock::now()), thread_([this, patience] { show(patience); }) {}

Progress::~Progress() { end(); }

void Progress::begin(const std::string& stage, std::size_t steps) {
  const std::lock_guard lock(mutex_);
  report_.begin(stage, steps, Clock::now());
  done_ = 0;
}

void Progress::announce(const std::string& text) {
  const std::lock_guard lock(mutex_);
  report_.wipe();
  stream_ << "equiaffine: progress: " << text << std::endl;
}

void Progress::end() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  ended_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Progress::warn(const std::string& text) {
  end();
  stream_ << "equiaffine: warning: " << printable(text) << '\n';
}

void Progress::show(Clock::duration patience) {
  constexpr auto period = std::chrono::milliseconds(100);
  std::unique_lock lock(mutex_);
  ended_.wait_for(lock, patience, [this] { return is_ended_; });
  while (!is_ended_) {
    report_.show(done_, Clock::now());
    ended_.wait_for(lock, period, [this] { return is_ended_; });
  }
  report_.wipe();
}

} // namespace equiaffine
