// SPDX-License-Identifier: GPL-3.0-or-later
// The spelling of options in messages: words of the command line, or arguments of functions in Python.
#ifndef EQUIAFFINE_PROGRAM_SYSTEM_FRONT_END_H
#define EQUIAFFINE_PROGRAM_SYSTEM_FRONT_END_H

#include <algorithm>
#include <string>

namespace equiaffine {

/// The front ends, which spell options differently.
enum class Front_end { COMMAND_LINE, PYTHON };

/// The front end of this process. The Python module sets it first.
inline Front_end front_end = Front_end::COMMAND_LINE;

/// The text for the front end of this process.
inline std::string by_front_end(const std::string& command_line, const std::string& python) {
  return front_end == Front_end::PYTHON ? python : command_line;
}

/// The option with the name of a field in C++: "--min-overlap" or "min_overlap". A space ends the name.
inline std::string option_text(std::string name) {
  if (front_end == Front_end::PYTHON) return name;
  std::replace(name.begin(), std::find(name.begin(), name.end(), ' '), '_', '-');
  return "--" + name;
}

/// The option with a value: "--scale none" or `scale="none"`, "--scale R" or "scale=R".
inline std::string option_text(const std::string& name, const std::string& value) {
  const bool is_word = value.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == std::string::npos;
  return option_text(name) + by_front_end(' ' + value, '=' + (is_word ? '"' + value + '"' : value));
}

} // namespace equiaffine

#endif
