// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_CLI_ATTRIBUTES_HELP_H
#define EQUIAFFINE_PROGRAM_CLI_ATTRIBUTES_HELP_H

#include <string>

namespace equiaffine {

/// The help of the option --attributes in lines of at most 88 characters, with the names of the library's table.
std::string attributes_help();

/// The same for the command annotate.
std::string attributes_of_fit_help();

} // namespace equiaffine

#endif
