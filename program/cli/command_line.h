// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_CLI_COMMAND_LINE_H
#define EQUIAFFINE_PROGRAM_CLI_COMMAND_LINE_H

#include "cli/Option_row.h"
#include "cli/option_values.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace equiaffine {

/// The words on the command line: those of every option that is given, before their meaning is read.
struct Command_line {
  Command command = MESH;
  std::map<std::string, Words> options;   ///< by the name() of the option's row
  std::optional<std::string> information; ///< help or version, if it was asked for

  bool has(const std::string& option) const { return options.count(option) > 0; }

  /// The first word of an option that is given.
  const std::string& word(const std::string& option) const { return options.at(option).front(); }
};

/// Splits the command line with CLI11. Words that an option needs are its own whatever they look like, so that `-.5`
/// and `-x^2` need no quoting tricks. Throws `Input_error` for a line that does not follow the grammar.
Command_line split_command_line(const std::vector<std::string>& arguments);

} // namespace equiaffine

#endif
