// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/program.h"
#include "system/signals.h"

#include <CGAL/assertions.h>
#include <CGAL/assertions_behaviour.h>

#include <iostream>
#include <unistd.h>

int main(int argc, char** argv) {
  equiaffine::clean_up_at_signals();
  CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {}); // they also throw
  return equiaffine::run({argv + 1, argv + argc}, {std::cout, std::cerr, ::isatty(STDERR_FILENO) == 1});
}
