// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_CLI_PARSE_OPTIONS_H
#define EQUIAFFINE_PROGRAM_CLI_PARSE_OPTIONS_H

#include "request/Request.h"

#include <string>
#include <vector>

namespace equiaffine {

/// Reads the command line, without the program's name. Throws `Input_error` for everything that makes no sense.
Request parse_options(const std::vector<std::string>& arguments);

} // namespace equiaffine

#endif
