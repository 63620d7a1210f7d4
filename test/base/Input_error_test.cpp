// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/base/Input_error.h>

#include <gtest/gtest.h>

#include <string>

namespace Input_error_test {

using equiaffine::Input_error;

TEST(Input_error, is_one_line_without_control_characters_whatever_it_quotes) {
  EXPECT_STREQ(Input_error("column 'a\nb\r\t\x1b[31m\x7f': no number").what(),
               "column 'a b  \\x1b[31m\\x7f': no number");
  EXPECT_STREQ(Input_error("file 'Fläche.csv': it is empty").what(), "file 'Fläche.csv': it is empty");
}

TEST(Input_error, keeps_the_lines_of_its_excerpt) { EXPECT_EQ(Input_error("", "x+\n  ^\n").excerpt(), "x+\n  ^\n"); }

} // namespace Input_error_test
