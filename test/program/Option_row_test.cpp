// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

namespace Option_row_test {

using namespace equiaffine;

constexpr Command commands[] = {MESH, EVALUATE, SAMPLE, VIEW, ANNOTATE, REGISTER, SYMMETRIES};

TEST(Program_Option_row, every_option_of_a_command_has_one_row) {
  for (const Command command : commands) {
    std::set<std::string> names;
    for (const Option_row* row : options_of(command)) EXPECT_TRUE(names.insert(row->name()).second) << row->name();
    EXPECT_EQ(names.count("--output"), 1U);
  }
}

TEST(Program_Option_row, the_name_is_the_long_one) {
  for (const Command command : commands)
    for (const Option_row* row : options_of(command))
      EXPECT_EQ(row->name().starts_with("--"), row->names.starts_with("-")) << row->names;
}

TEST(Program_Option_row, every_option_is_documented) {
  const std::filesystem::path test_folder = std::filesystem::path(EQUIAFFINE_TEST_DATA).parent_path();
  const std::string page = test::read_file(test_folder.parent_path() / "doc/program.md");
  ASSERT_NE(page, "");
  for (const Command command : commands)
    for (const Option_row* row : options_of(command)) {
      const std::string name = row->name() == "--output" ? "-o OUT" : row->name();
      EXPECT_NE(page.find(name), std::string::npos) << name;
    }
}

} // namespace Option_row_test
