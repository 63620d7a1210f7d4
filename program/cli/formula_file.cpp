// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/formula_file.h"

#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/internal/input_file.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iterator>

namespace equiaffine {

std::optional<std::string> formula_file(const std::string& word) {
  if (!word.starts_with('@')) return std::nullopt;
  return word.substr(1);
}

std::string read_formula(const std::string& path) {
  constexpr std::size_t most = 1'000'000; // bytes, far more than anybody writes
  if (path.empty()) throw Input_error("--function: there is no file name after the @; write --function @FILE");
  std::ifstream file = open_input(path);
  std::string text(most + 1, '\0');
  text.resize(std::size_t(file.read(text.data(), std::streamsize(text.size())).gcount()));
  if (text.size() > most)
    throw Input_error("cannot read '" + path + "': it has more than a million bytes; give a file with one formula");
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3); // the byte order mark of editors
  std::erase(text, '\r');
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  text.erase(std::find_if(text.rbegin(), text.rend(), [](char c) { return c != ' '; }).base(), text.end());
  if (text.empty()) throw Input_error("cannot read '" + path + "': it holds no formula; write one into it");
  return text;
}

} // namespace equiaffine
