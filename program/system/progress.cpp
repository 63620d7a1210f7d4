// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/progress.h"

#include <equiaffine/base/internal/printable.h>

namespace equiaffine {

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
