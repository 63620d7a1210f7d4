// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_WHAT_TO_TRY_H
#define EQUIAFFINE_PROGRAM_COMMANDS_WHAT_TO_TRY_H

#include "commands/find_map.h"
#include "output/maps.h"
#include "request/options.h"

#include <string>
#include <vector>

namespace equiaffine {

/// Returns what may find a map where none was found, the most promising first.
std::vector<std::string> what_to_try(const Register_options& options, const Found_map& found);

/// Returns what may find symmetries where only the identity was found, or nothing was decided.
std::vector<std::string> what_to_try(const Symmetries_options& options, const Symmetries& found);

} // namespace equiaffine

#endif
