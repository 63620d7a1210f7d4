// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/progress.h"

#include <equiaffine/base/printable.h>

#include <algorithm>

namespace equiaffine {

Progress::Progress(std::ostream& terminal, bool is_terminal, Clock::duration patience)
    : terminal_(terminal), patience_(patience) {
  if (is_terminal) thread_ = std::thread([this] { show_until_ended(); });
}

Progress::~Progress() { end(); }

void Progress::begin(const std::string& stage, std::size_t steps) {
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  steps_ = steps;
  done_ = 0;
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
  terminal_ << "equiaffine: warning: " << printable(text) << '\n';
}

void Progress::show_until_ended() {
  constexpr auto period = std::chrono::milliseconds(100);
  constexpr const char* wipe = "\r\x1b[K"; // goes to the beginning of the line and erases it
  bool is_shown = false;
  std::unique_lock lock(mutex_);
  ended_.wait_for(lock, patience_, [this] { return is_ended_; });
  while (!is_ended_) {
    terminal_ << wipe << line() << std::flush;
    is_shown = true;
    ended_.wait_for(lock, period, [this] { return is_ended_; });
  }
  if (is_shown) terminal_ << wipe << std::flush;
}

std::string Progress::line() const {
  constexpr std::size_t width = 24;
  const auto elapsed = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - start_).count();
  std::string bar(width, '.');
  std::string percent = "     ";
  if (steps_ > 0) {
    const double fraction = std::min(double(done_) / double(steps_), 1.);
    std::fill_n(bar.begin(), std::size_t(fraction * double(width)), '#');
    percent = std::to_string(int(fraction * 100)) + " %";
    percent.insert(0, 5 - percent.size(), ' ');
  } else { // without a number of steps a mark goes to and fro
    const std::size_t place = std::size_t(elapsed / 100) % (2 * width - 2);
    bar[place < width ? place : 2 * width - 2 - place] = '#';
  }
  return "[" + bar + "] " + percent + "  " + stage_ + ", " + std::to_string(elapsed / 1000) + " s";
}

} // namespace equiaffine
