// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>
#include <string>
#include <thread>

namespace progress_test {

TEST(Program_progress, is_shown_on_a_terminal_and_wiped_away) {
  std::ostringstream terminal;
  {
    equiaffine::Progress progress(terminal, true, std::chrono::milliseconds(0));
    progress.begin("counting", 4);
    progress.advance(3);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  EXPECT_NE(terminal.str().find("[##################......]  75 %  counting, 0 s, about 0 s left"), std::string::npos)
      << terminal.str();
  EXPECT_TRUE(terminal.str().ends_with("\r\x1b[K"));
}

TEST(Program_progress, is_not_shown_in_a_pipe_or_for_short_work) {
  std::ostringstream pipe, terminal;
  equiaffine::Progress(pipe, false, std::chrono::milliseconds(0)).begin("working");
  equiaffine::Progress(terminal, true).begin("working");
  EXPECT_EQ(pipe.str() + terminal.str(), "");
}

} // namespace progress_test
