// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"
#include "support/run_program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace Option_row_test {

using namespace equiaffine;

constexpr Command commands[] = {MESH, EVALUATE, SAMPLE, VIEW, ANNOTATE, REGISTER, SYMMETRIES};

TEST(Program_Option_row, every_option_of_a_command_has_one_row) {
  for (const Command command : commands) {
    std::set<std::string> names;
    for (const Option_row* row : options_of(command)) EXPECT_TRUE(names.insert(row->name()).second) << row->name();
    EXPECT_EQ(names.count("output"), 1U);
  }
}

TEST(Program_Option_row, the_name_is_the_first_long_one) {
  for (const Command command : commands)
    for (const Option_row* row : options_of(command)) {
      if (!row->names.starts_with('-')) EXPECT_EQ(row->name(), row->names);
      else EXPECT_TRUE(row->has_name(option_text(row->name()))) << row->names;
    }
}

class Program_documentation : public testing::Test {
protected:
  static std::filesystem::path project() {
    return std::filesystem::path(EQUIAFFINE_TEST_DATA).parent_path().parent_path();
  }
  static std::string page() { return test::read_file(project() / "doc/program.md"); }

  /// The structs of options that headers define.
  static std::set<std::string> structs() {
    std::set<std::string> names;
    const std::regex pattern("\nstruct (\\w+_options) \\{");
    for (const auto& file : std::filesystem::recursive_directory_iterator(project() / "include")) {
      if (!file.is_regular_file()) continue;
      const std::string text = test::read_file(file.path());
      for (std::sregex_iterator found(text.begin(), text.end(), pattern), end; found != end; ++found)
        names.insert((*found)[1]);
    }
    return names;
  }
};

TEST_F(Program_documentation, has_every_option) {
  for (const Command command : commands)
    for (const Option_row* row : options_of(command)) {
      const std::string name = row->name() == "output" ? "-o OUT" : row->names.substr(0, row->names.find(','));
      EXPECT_NE(page().find(name), std::string::npos) << name;
    }
}

TEST_F(Program_documentation, has_one_name_for_each_option) {
  std::map<std::string, std::string> names; // of fields, by what the program writes
  for (const Command command : commands)
    for (const Option_row* row : options_of(command)) {
      const std::string name = row->name();
      names[option_text(name)] = name.substr(name.starts_with("no_") ? 3 : 0);
    }
  std::istringstream lines(page());
  const std::regex pattern("\\| `(--[a-z-]+)` \\| (`(\\w+)::(\\w+)` )?\\| (`(\\w+)` )?\\| (`Set(\\w+)` )?\\|");
  const std::set<std::string> known = structs();
  int found = 0;
  std::smatch match;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_match(line, match, pattern)) continue;
    ++found;
    ASSERT_TRUE(names.contains(match[1])) << line;
    const std::string field = names[match[1]];
    EXPECT_TRUE(!match[3].matched || known.contains(match[3])) << line;
    for (const std::string& name : {match[4].str(), match[6].str()}) EXPECT_TRUE(name.empty() || name == field) << line;
    std::string word = match[8], lower = std::regex_replace(field, std::regex("_"), "");
    std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    EXPECT_TRUE(word.empty() || word == lower) << line;
  }
  EXPECT_GT(found, 30);
}

} // namespace Option_row_test
