// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/run_program.h"
#include "system/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>

namespace Progress_report_test {

using namespace equiaffine;
using std::chrono::seconds;

const Progress_report::Time start{};

TEST(Program_progress_report, a_terminal_has_the_percentage_and_the_time_left_of_the_stage) {
  std::ostringstream terminal;
  Progress_report report(terminal, true, start);
  report.begin("counting", 4, start + seconds(6));
  report.show(1, start + seconds(8));
  EXPECT_EQ(terminal.str(), "\r\x1b[K[######..................]  25 %  counting, 8 s, about 6 s left");
  report.show(4, start + seconds(14));
  EXPECT_TRUE(terminal.str().ends_with("[########################] 100 %  counting, 14 s, about 0 s left"));
  report.wipe();
  EXPECT_TRUE(terminal.str().ends_with("left\r\x1b[K"));
}

TEST(Program_progress_report, elsewhere_there_is_a_line_every_ten_seconds_and_one_at_once_if_minutes_are_left) {
  std::ostringstream file;
  Progress_report report(file, false, start);
  report.begin("counting", 100, start);
  for (int second = 0; second < 30; ++second) report.show(std::size_t(second), start + seconds(second));
  report.wipe();
  EXPECT_EQ(file.str(), "equiaffine: progress: counting, 1 %, 1 s, about 1 min 39 s left\n"
                        "equiaffine: progress: counting, 11 %, 11 s, about 1 min 29 s left\n"
                        "equiaffine: progress: counting, 21 %, 21 s, about 1 min 19 s left\n");
  EXPECT_EQ(test::without_progress("equiaffine: warning: old\n" + file.str()), "equiaffine: warning: old\n");
}

TEST(Program_progress_report, a_stage_without_a_number_of_steps_has_the_time_alone) {
  std::ostringstream file, terminal;
  Progress_report report(file, false, start), shown(terminal, true, start);
  report.begin("reading", 0, start);
  report.show(7, start + seconds(2 * 3600 + 300));
  EXPECT_EQ(file.str(), "equiaffine: progress: reading, 2 h 5 min\n");
  shown.begin("reading", 0, start);
  shown.show(7, start);
  EXPECT_TRUE(terminal.str().ends_with("[#.......................]        reading, 0 s")) << terminal.str();
}

} // namespace Progress_report_test
