// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/program.h"
#include "system/atomic_file.h"

#include <CGAL/assertions.h>
#include <CGAL/assertions_behaviour.h>

#include <csignal>
#include <iostream>
#include <unistd.h>

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN); // a reader that goes away is an error of writing, and temporary files get removed
  equiaffine::remove_temporary_folders_when_interrupted();
  CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {}); // they also throw
  return equiaffine::run({argv + 1, argv + argc}, {std::cout, std::cerr, ::isatty(STDERR_FILENO) == 1});
}
