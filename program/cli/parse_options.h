// SPDX-License-Identifier: GPL-3.0-or-later
// Turns the words of a command line into the request that a command executes.
#ifndef EQUIAFFINE_PROGRAM_CLI_PARSE_OPTIONS_H
#define EQUIAFFINE_PROGRAM_CLI_PARSE_OPTIONS_H

#include "cli/command_line.h"

#include <string>
#include <vector>

namespace equiaffine {

/// Reads the command line, without the program's name. Throws `Input_error` for everything that makes no sense.
Request parse_options(const std::vector<std::string>& arguments);

/// The same of a line that is split.
Request read_options(const Command_line& line);

/// The same of the two lines of `register`. Options that belong to neither source are on the first one.
Request read_options(const Command_line& source, const Command_line& target);

} // namespace equiaffine

#endif
