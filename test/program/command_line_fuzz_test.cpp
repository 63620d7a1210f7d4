// SPDX-License-Identifier: GPL-3.0-or-later
// Any command line, one word per line, is understood or refused.
#include "cli/parse_options.h"
#include "support/fuzz_target.h"

#include <sstream>
#include <string>
#include <vector>

EQUIAFFINE_FUZZ_TARGET(command_line) {
  std::istringstream lines{std::string(input)};
  std::vector<std::string> words;
  for (std::string word; std::getline(lines, word);) words.push_back(word);
  equiaffine::test::accepts([&] { equiaffine::parse_options(words); });
}
