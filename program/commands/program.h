// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_PROGRAM_H
#define EQUIAFFINE_PROGRAM_COMMANDS_PROGRAM_H

#include <ostream>
#include <string>
#include <vector>

namespace equiaffine {

/// The streams for texts that people read. Data for standard output are written elsewhere.
struct Streams {
  std::ostream& out;
  std::ostream& error;
  bool error_is_terminal = false; ///< if true, a long computation shows its progress there
};

/// Runs the program with the arguments (without the program's name) and returns the exit status. It is 0 for success, 2
/// for an error of the user, which is written to `error` in one line, or in more lines if they show the place, and 1
/// for a defect of the program.
int run(const std::vector<std::string>& arguments, const Streams& streams);

} // namespace equiaffine

#endif
