// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/Option_reader.h"

#include <equiaffine/base/Input_error.h>

namespace equiaffine {

void Option_reader::read(const Option_row& row) {
  const std::string name = row.name();
  if (has(name) && names_read_.insert(name).second) row.read({name, line_.options.at(name)}, draft_);
}

void Option_reader::read(std::initializer_list<const char*> options) {
  for (const std::string option : options)
    for (const Option_row* row : options_of(command()))
      if (row->name() == option) read(*row);
}

void Option_reader::read_rest() {
  for (const Option_row* row : options_of(command())) read(*row);
}

void Option_reader::refuse(std::initializer_list<const char*> options, const std::string& reason,
                           const std::string& advice) const {
  for (const char* option : options)
    if (has(option)) fail_option(option, reason, advice);
}

void Option_reader::need(const std::string& option, const std::string& advice) const {
  if (!has(option)) throw Input_error("the option " + option + " is missing; " + advice);
}

} // namespace equiaffine
