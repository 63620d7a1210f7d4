// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the program with what a user can do wrong.
#ifndef EQUIAFFINE_TEST_PROGRAM_ERRORS_FIXTURE_H
#define EQUIAFFINE_TEST_PROGRAM_ERRORS_FIXTURE_H

#include "support/run_program.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace errors_fixture {

using namespace equiaffine::test;

inline const Arguments box = {"--box", "-2", "2", "-2", "2", "-2", "2"};

inline Arguments mesh_of(const std::string& expression) {
  return Arguments{"mesh", "--function", expression, "-o", "out.ply"};
}

/// Everything that a user can do wrong: status 2, one line that names the thing, and nothing is written.
class Program_errors : public Program_test {
protected:
  Program_errors() {
    write_file(folder_ / "out.ply", "old");
    before_ = names();
  }

  /// `words` are in the line on standard error, which `excerpt` follows.
  void expect_error(const Arguments& arguments, const Arguments& words, const std::string& excerpt = {}) {
    const Result result = run(arguments);
    const std::size_t end = result.error.find('\n');
    const std::string line = result.error.substr(0, end);
    EXPECT_EQ(result.status, 2) << line;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(line.starts_with("equiaffine: error: ")) << result.error;
    ASSERT_NE(end, std::string::npos);
    EXPECT_EQ(result.error.substr(end + 1), excerpt);
    for (const std::string& word : words) EXPECT_NE(line.find(word), std::string::npos) << word << " in " << line;
    EXPECT_EQ(file("out.ply"), "old");
    EXPECT_EQ(names(), before_);
  }

  void add_input(const std::string& name, const std::string& text) {
    write_file(folder_ / name, text);
    before_ = names();
  }

  Arguments before_;
};

} // namespace errors_fixture

#endif
