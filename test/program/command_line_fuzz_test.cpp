// SPDX-License-Identifier: GPL-3.0-or-later
// Any command line, one word per line, is understood or refused.
#include "cli/parse_options.h"
#include "support/fuzz_target.h"

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace command_line_fuzz_test {

static std::vector<std::string> words_of(std::string_view input) {
  std::istringstream lines{std::string(input)};
  std::vector<std::string> words;
  for (std::string word; std::getline(lines, word);) words.push_back(word);
  return words;
}

EQUIAFFINE_FUZZ_TARGET(command_line) {
  equiaffine::test::accepts([&] { equiaffine::parse_options(words_of(input)); });
}

#ifndef EQUIAFFINE_FUZZING
// From a line that is refused at an early word, a fuzzer does not reach the later ones.
TEST(Command_line_corpus, holds_lines_that_are_understood) {
  for (const auto& entry : std::filesystem::directory_iterator(EQUIAFFINE_TEST_DATA "/fuzz/command_line")) {
    std::ifstream file(entry.path());
    const std::string input{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    EXPECT_NO_THROW(equiaffine::parse_options(words_of(input))) << entry.path();
  }
}
#endif

} // namespace command_line_fuzz_test
