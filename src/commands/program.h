// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_COMMANDS_PROGRAM_H
#define EQUIAFFINE_SRC_COMMANDS_PROGRAM_H

#include <ostream>
#include <string>
#include <vector>

namespace equiaffine {

/// Where the program speaks to people. Data that go to standard output do so by themselves.
struct Streams {
  std::ostream& out;
  std::ostream& error;
  bool error_is_terminal = false; ///< then a long computation shows its progress there
};

/// The program: does what the arguments (without the program's name) say and returns the exit status. 0; 2 for an error
/// of the user, told in one line on `error`, more lines if they show the place; 1 for a defect.
int run(const std::vector<std::string>& arguments, const Streams& streams);

} // namespace equiaffine

#endif
