// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/files.h"
#include "system/process.h"

#include <gtest/gtest.h>
#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#endif

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <unistd.h>

namespace signals_test {

namespace fs = std::filesystem;

using equiaffine::Temporary_folder;

class Program_signals : public testing::Test {
protected:
  Program_signals() {
    std::string name = (fs::temp_directory_path() / "equiaffine-test-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Program_signals() override { fs::remove_all(folder_); }

  /// A process with a file in a temporary folder sends itself a signal.
  void receive(int signal) const {
    equiaffine::clean_up_at_signals();
    const Temporary_folder temporary(folder_);
    std::ofstream(temporary.path() / "file") << "text";
    ::kill(::getpid(), signal);
    while (true) ::pause();
  }

  bool is_empty() const { return fs::is_empty(folder_); }

  fs::path folder_;
};

using Program_signals_DeathTest = Program_signals;

TEST_F(Program_signals_DeathTest, that_ask_for_the_end_remove_temporary_folders) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGQUIT, SIGALRM, SIGUSR1, SIGUSR2, SIGVTALRM, SIGPROF, SIGXCPU}) {
    EXPECT_EXIT(receive(signal), testing::ExitedWithCode(128 + signal), "");
    EXPECT_TRUE(is_empty()) << signal;
  }
}

TEST_F(Program_signals_DeathTest, of_crashes_remove_temporary_folders_and_ask_for_a_report) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP}) {
    EXPECT_EXIT(receive(signal), testing::KilledBySignal(signal),
                "^equiaffine: internal error: the program crashed[^\n]*please report[^\n]*\n$");
    EXPECT_TRUE(is_empty()) << signal;
  }
}

#ifdef CGAL_LINKED_WITH_TBB

/// Fills the stack, unless the byte is not zero, which the compiler does not know.
int fill_stack(const volatile char* byte) { // NOLINT(misc-no-recursion)
  std::array<volatile char, 1024> block;
  block[0] = *byte;
  return block[0] != 0 ? 0 : 1 + fill_stack(block.data());
}

TEST_F(Program_signals_DeathTest, of_full_stacks_are_like_those_of_other_crashes_in_every_thread) {
  if (tbb::info::default_concurrency() < 2) GTEST_SKIP() << "TBB has no other thread";
  const auto overflow = [&](bool is_worker) {
    equiaffine::clean_up_at_signals();
    const Temporary_folder temporary(folder_);
    std::ofstream(temporary.path() / "file") << "text";
    const auto main_thread = std::this_thread::get_id();
    tbb::parallel_for(0, 2, [&](int) {
      constexpr char zero = 0;
      if ((std::this_thread::get_id() != main_thread) == is_worker) std::_Exit(fill_stack(&zero));
      while (true) ::pause();
    });
  };
  for (const bool is_worker : {false, true}) {
    EXPECT_EXIT(overflow(is_worker), testing::KilledBySignal(SIGSEGV), "^equiaffine: internal error[^\n]*\n$");
    EXPECT_TRUE(is_empty()) << is_worker;
  }
}

#endif

TEST_F(Program_signals_DeathTest, that_were_ignored_stay_ignored) {
  const auto survive = [&] {
    std::signal(SIGHUP, SIG_IGN);
    equiaffine::clean_up_at_signals();
    std::raise(SIGHUP);
    std::raise(SIGPIPE);
    std::_Exit(0);
  };
  EXPECT_EXIT(survive(), testing::ExitedWithCode(0), "");
}

TEST_F(Program_signals, a_folder_that_a_killed_process_left_is_removed_by_the_next_one) {
  const fs::path abandoned = folder_ / ".equiaffine-temporary-abcdef",
                 recent = folder_ / ".equiaffine-temporary-ghijkl", backup = folder_ / ".equiaffine-backup",
                 open_to_all = folder_ / ".equiaffine-temporary-mnopqr";
  const Temporary_folder used(folder_);
  for (const fs::path& path : {abandoned, recent, backup, open_to_all, used.path()}) {
    fs::create_directory(path);
    fs::permissions(path, path == open_to_all ? fs::perms(0755) : fs::perms::owner_all);
    std::ofstream(path / "file") << "text";
  }
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for (const fs::path& path : {abandoned, backup, open_to_all, used.path()}) fs::last_write_time(path, long_ago);
  const Temporary_folder next(folder_);
  EXPECT_FALSE(fs::exists(abandoned));
  for (const fs::path& path : {recent, backup, open_to_all, used.path(), next.path()})
    EXPECT_TRUE(fs::exists(path)) << path;
}

} // namespace signals_test
