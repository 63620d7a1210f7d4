// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/process.h"
#include <equiaffine/base/Input_error.h>

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <sys/resource.h>

namespace Shared_memory_test {

using equiaffine::Shared_memory;

TEST(Shared_memory_DeathTest, says_that_the_limit_of_the_size_of_files_is_too_small) {
  const auto allocate_beyond_limit = [] {
    constexpr rlimit limit = {1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
    try {
      Shared_memory().allocate(2000);
    } catch (const equiaffine::Input_error& error) {
      std::cerr << error.what();
      std::_Exit(2);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(allocate_beyond_limit(), testing::ExitedWithCode(2), "less than the 2000 bytes.*ulimit -f");
}

} // namespace Shared_memory_test
