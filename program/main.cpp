// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/commands.h"
#include "system/process.h"

#include <CGAL/assertions.h>
#include <CGAL/assertions_behaviour.h>

#include <iostream>
#include <unistd.h>

int main(int argc, char** argv) {
  equiaffine::clean_up_at_signals();
  const auto print_nothing = [](const char*, const char*, const char*, int, const char*) {};
  CGAL::set_error_handler(print_nothing); // errors throw anyway
  CGAL::set_warning_handler(print_nothing);
  return equiaffine::run({argv + 1, argv + argc}, {std::cout, std::cerr, ::isatty(STDERR_FILENO) == 1});
}
