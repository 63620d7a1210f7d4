// SPDX-License-Identifier: GPL-3.0-or-later
// Turns a command line into a request.
#ifndef EQUIAFFINE_PROGRAM_CLI_PARSE_OPTIONS_H
#define EQUIAFFINE_PROGRAM_CLI_PARSE_OPTIONS_H

#include "cli/command_line.h"

#include <string>
#include <vector>

namespace equiaffine {

/// Reads the command line, without the program's name. Throws `Input_error` if it is invalid.
Request parse_options(const std::vector<std::string>& arguments);

/// The same for a line that is already split.
Request read_options(const Command_line& line);

/// The same for the two lines of `register`. Options that belong to neither source are on the first one.
Request read_options(const Command_line& source, const Command_line& target);

} // namespace equiaffine

#endif
