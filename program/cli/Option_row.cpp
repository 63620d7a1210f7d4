// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/Option_row.h"

namespace equiaffine {

std::vector<const Option_row*> options_of(Command command) {
  std::vector<const Option_row*> rows;
  for (const auto& part : {source_options(), surface_options(), map_options(), output_options()})
    for (const Option_row& row : part)
      if (row.commands & command) rows.push_back(&row);
  return rows;
}

} // namespace equiaffine
