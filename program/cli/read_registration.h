// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_CLI_READ_REGISTRATION_H
#define EQUIAFFINE_PROGRAM_CLI_READ_REGISTRATION_H

#include "cli/Option_reader.h"

namespace equiaffine {

/// Reads the command line of `register`: one source stands before the word `to`, the other one after it, and options
/// that belong to neither may stand on both sides. Throws `Input_error`.
Options parse_register_options(const Words& arguments);

Symmetries_options read_symmetries_options(Option_reader& reader);

} // namespace equiaffine

#endif
