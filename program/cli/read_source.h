// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_CLI_READ_SOURCE_H
#define EQUIAFFINE_PROGRAM_CLI_READ_SOURCE_H

#include "cli/Option_reader.h"

namespace equiaffine {

/// Reads the options of the source, and checks that they go together.
void read_source(Option_reader& reader);

} // namespace equiaffine

#endif
