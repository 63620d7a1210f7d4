// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_CLI_COMMAND_LINE_H
#define EQUIAFFINE_SRC_CLI_COMMAND_LINE_H

#include "cli/option_values.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace equiaffine {

/// What stands on the command line: the words of every option that is given. Their meaning is a matter of options.h.
struct Command_line {
  std::string command;
  std::map<std::string, Words> options;   ///< "-o" is "--output"; the positional of `view` is "MESH.ply"
  std::optional<std::string> information; ///< help or version, if it was asked for

  bool has(const std::string& option) const { return options.count(option) > 0; }

  /// The word of an option that is given or has a default.
  const std::string& word(const std::string& option, const std::string& otherwise) const {
    return has(option) ? options.at(option).front() : otherwise;
  }
};

/// Splits the command line with CLI11. Words that an option needs are its own whatever they look like, so that `-.5`
/// and `-x^2` need no quoting tricks. Throws `Input_error` for a line that does not follow the grammar.
Command_line split_command_line(const std::vector<std::string>& arguments);

} // namespace equiaffine

#endif
