// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef __linux__

#include "support/run_program.h"
#include "system/file_memory.h"
#include "system/memory_limit.h"
#include "system/process.h"
#include <equiaffine/base/Input_error.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <linux/magic.h>
#include <new>
#include <set>
#include <string>
#include <sys/resource.h>
#include <sys/statfs.h>
#include <thread>
#include <vector>

namespace memory_limit_test {

using namespace equiaffine;
using Words = std::vector<std::string>;

class Program_memory : public test::Program_test {
protected:
  /// Runs the program, which has to succeed, and returns the greatest size of its resident set in MiB.
  double memory_of(const Words& arguments) const {
    int status = -1;
    struct rusage usage = {};
    ::wait4(start(arguments), &status, 0, &usage);
    EXPECT_EQ(status, 0) << test::read_file(root_ / "error");
    return double(usage.ru_maxrss) / 1024;
  }

  Words with_limit(Words arguments, const std::string& limit, const std::string& output) const {
    arguments.insert(arguments.end(), {"--memory", limit, "-o", output});
    return arguments;
  }

  /// Expects that a command takes much more memory than the limit without it, and no more with it, for the same bytes.
  void expect_same_with(int limit, const Words& arguments, const std::string& extension) const {
    Words free = arguments;
    free.insert(free.end(), {"-o", "free" + extension});
    EXPECT_GT(memory_of(free), 1.2 * limit) << "the test shows nothing";
    EXPECT_LE(memory_of(with_limit(arguments, std::to_string(limit) + "M", "limited" + extension)), 1.1 * limit);
    EXPECT_EQ(file("free" + extension), file("limited" + extension));
  }

  /// Waits until the program has made the folder of its output, or has ended.
  void wait_for_temporary_folder(pid_t child) const {
    const auto is_there = [&] {
      const Words all = names();
      return std::any_of(all.begin(), all.end(), [&](const std::string& name) { return !known_.contains(name); });
    };
    siginfo_t end = {};
    while (!is_there() && end.si_pid == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ::waitid(P_PID, id_t(child), &end, WEXITED | WNOHANG | WNOWAIT);
    }
  }

  const Words sphere = {"mesh", "--function", "x^2+y^2+z^2-1", "--box", "-1", "1", "-1", "1",
                        "-1",   "1",          "--resolution"};
  std::set<std::string> known_; ///< files that are there before the program is started
};
using Program_memory_long = Program_memory;

Words joined(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(Program_memory_long, of_a_mesh_is_limited_for_the_same_bytes) {
  const Words mesh = joined(sphere, {"640"});
  expect_same_with(190, mesh, ".ply");
  expect_same_with(190, joined(mesh, {"--attributes", "normal,k1,k2"}), ".vtp");
  EXPECT_EQ(names(), (Words{"free.ply", "free.vtp", "limited.ply", "limited.vtp"}));
}

TEST_F(Program_memory_long, of_volumes_is_limited_and_mapped_files_count) {
  run_well({"sample", "--function", "x^2+y^2+z^2-1", "--box", "-1.2", "1.2", "-1.2", "1.2", "-1.2", "1.2",
            "--resolution", "300", "--type", "double", "--memory", "220M", "-o", "v.mha"});
  expect_same_with(200, {"mesh", "--volume", "v.mha", "--attributes", "none"}, ".ply");
  expect_same_with(220, {"mesh", "--volume", "v.mha", "--smoothing", "2", "--attributes", "none"}, ".csv");
  test::write_file(folder_ / "points.csv", "x,y,z\n1,0,0\n0,0.5,0\n");
  expect_same_with(220, {"evaluate", "--volume", "v.mha", "--smoothing", "2", "--points", "points.csv"}, ".csv");
}

TEST_F(Program_memory, that_cannot_do_is_refused_with_one_that_would) {
  const test::Result refused = run(with_limit(joined(sphere, {"20"}), "10M", "s.ply"));
  EXPECT_EQ(refused.status, 2);
  const std::string advice = "give at least ";
  ASSERT_NE(refused.error.find(advice), std::string::npos) << refused.error;
  std::string least = refused.error.substr(refused.error.find(advice) + advice.size());
  least.erase(least.find('\n'));
  run_well(with_limit(joined(sphere, {"20"}), least, "s.ply"));
}

TEST_F(Program_memory, of_a_library_in_a_child_counts_and_ends_the_command_with_a_limit_that_does) {
  run_well({"sample", "--function", "x^2+y^2+z^2-1", "--box", "-1.2", "1.2", "-1.2", "1.2", "-1.2", "1.2",
            "--resolution", "260", "-o", "v.vti"});
  test::write_file(folder_ / "points.csv", "x,y,z\n1,0,0\n");
  const Words evaluate = {"evaluate", "--volume", "v.vti", "--points", "points.csv"};
  const test::Result ended = run(with_limit(evaluate, "200M", "e.csv"));
  EXPECT_EQ(ended.status, 2);
  const std::string begin = "equiaffine: error: --memory: 200M are too few for the data", advice = "such as ";
  EXPECT_TRUE(ended.error.starts_with(begin)) << ended.error;
  EXPECT_EQ(names(), (Words{"points.csv", "v.vti"}));
  ASSERT_NE(ended.error.find(advice), std::string::npos) << ended.error;
  std::string enough = ended.error.substr(ended.error.find(advice) + advice.size());
  enough.erase(enough.find(','));
  run_well(with_limit(evaluate, enough, "e.csv"));
}

TEST_F(Program_memory, is_an_amount) {
  for (const char* word : {"700", "M", "-1G", "0M", "1K", "700m", "nanG", "1e30G"}) {
    const test::Result result = run(with_limit(joined(sphere, {"20"}), word, "s.ply"));
    EXPECT_EQ(result.status, 2) << word;
    EXPECT_NE(result.error.find("write for example 700M or 2G"), std::string::npos) << result.error;
  }
  run_well(with_limit(joined(sphere, {"20"}), "1.5G", "s.ply"));
}

TEST_F(Program_memory, says_that_files_may_not_be_large_enough_to_keep_what_does_not_fit) {
  rlimit before = {};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit limit = {20'000'000, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  const test::Result refused = run(with_limit(joined(sphere, {"640"}), "190M", "s.ply"));
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.error.find("has no room for data that do not fit into memory (File too large)"), std::string::npos)
      << refused.error;
  EXPECT_EQ(names(), Words());
}

TEST_F(Program_memory, is_not_kept_in_a_folder_that_is_itself_in_memory) {
  struct statfs facts;
  if (::statfs("/dev/shm", &facts) != 0 || facts.f_type != TMPFS_MAGIC) GTEST_SKIP() << "no such folder is known";
  const test::Result result = run(with_limit(joined(sphere, {"20"}), "1G", "/dev/shm/equiaffine-test.ply"));
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.error.find("'/dev/shm': it is itself in memory; choose a folder on a disk"), std::string::npos)
      << result.error;
}

TEST_F(Program_memory, leaves_nothing_behind_when_it_is_ended) {
  for (const int signal : {SIGINT, SIGTERM, SIGKILL})
    for (const int milliseconds : {0, 200, 500}) {
      const Words before = names(); // those of a process that was killed
      known_ = std::set<std::string>(before.begin(), before.end());
      const pid_t child = start(with_limit(joined(sphere, {"900"}), "200M", "s.ply"));
      wait_for_temporary_folder(child);
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      ::kill(child, signal);
      const test::Result result = wait_for(child);
      if (result.status == 0) {
        std::filesystem::remove(folder_ / "s.ply");
        continue;
      }
      EXPECT_EQ(result.status, signal == SIGKILL ? -1 : 128 + signal);
      if (signal != SIGKILL) {
        EXPECT_EQ(names(), Words());
      }
      EXPECT_FALSE(std::filesystem::exists(folder_ / "s.ply"));
    }
}

/// A folder with scratch memory, in a process that is ended by std::_Exit.
class Scratch_memory_DeathTest : public test::Program_test {
protected:
  static void end(bool is_right) { std::_Exit(is_right ? 0 : 1); }

  /// Allows this process no file of more than a megabyte.
  static void limit_size_of_files() {
    constexpr rlimit limit = {1'000'000, 1'000'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);
  }
};

TEST_F(Scratch_memory_DeathTest, keeps_what_is_in_it_when_its_pages_are_given_back) {
  const auto check = [&] {
    open_scratch_memory(folder_, 1 << 20);
    constexpr std::size_t size = 300'000;
    auto* const a = static_cast<unsigned char*>(allocate_scratch_memory(size));
    auto* const b = static_cast<unsigned char*>(allocate_scratch_memory(size));
    for (std::size_t i = 0; i < size; ++i) {
      a[i] = static_cast<unsigned char>(i % 251);
      b[i] = static_cast<unsigned char>(i % 13);
    }
    release_reclaimable_memory();
    bool is_right = is_scratch_memory(a) && is_scratch_memory(b + size - 1) && !is_scratch_memory(&is_right);
    for (std::size_t i = 0; i < size; ++i) is_right = is_right && a[i] == i % 251 && b[i] == i % 13;
    free_scratch_memory(a);
    is_right = is_right && allocate_scratch_memory(size) == a; // what is spare is used again
    end(is_right && names().empty());
  };
  EXPECT_EXIT(check(), testing::ExitedWithCode(0), "");
}

TEST_F(Scratch_memory_DeathTest, limit_counts_what_a_child_shares_with_its_parent_once) {
  const auto check = [&] {
    constexpr std::size_t mebibyte = 1 << 20;
    limit_resident_memory(300 * mebibyte, folder_);
    const std::vector<std::vector<char>> small(100, std::vector<char>(2 * mebibyte, 1)); // too small for a file
    run_in_child([] { std::this_thread::sleep_for(std::chrono::milliseconds(300)); }, {10, 1e9});
    end(small.size() == 100);
  };
  EXPECT_EXIT(check(), testing::ExitedWithCode(0), "");
}

TEST_F(Scratch_memory_DeathTest, of_a_child_is_limited_with_its_memory) {
  const auto check = [&] {
    limit_resident_memory(std::size_t(1) << 30, folder_);
    const auto allocate = [] { allocate_scratch_memory(2'000'000); };
    run_in_child(allocate, {10, 1e8});
    try {
      run_in_child(allocate, {10, 1e6});
    } catch (const No_room_for_scratch_memory&) {
    } catch (const std::bad_alloc&) {
      end(true);
    }
    end(false);
  };
  EXPECT_EXIT(check(), testing::ExitedWithCode(0), "");
}

TEST_F(Scratch_memory_DeathTest, of_a_child_without_room_is_an_error_that_says_so) {
  const auto check = [&] {
    limit_resident_memory(std::size_t(1) << 30, folder_);
    limit_size_of_files();
    try {
      const auto task = [] { // does as libraries that make an error of their own of an exception
        try {
          allocate_scratch_memory(2'000'000);
        } catch (const std::bad_alloc&) {
          throw Input_error("it is damaged");
        }
      };
      run_in_child(task, {10, 1e8});
    } catch (const Input_error& error) {
      end(std::string(error.what()).starts_with("--memory: the folder '" + folder_.string() + "' has no room"));
    }
    end(false);
  };
  EXPECT_EXIT(check(), testing::ExitedWithCode(0), "");
}

TEST_F(Scratch_memory_DeathTest, of_a_child_is_its_own) {
  const auto check = [&] {
    open_scratch_memory(folder_, 0);
    constexpr std::size_t size = 300'000;
    auto* const parents = static_cast<char*>(allocate_scratch_memory(size));
    parents[0] = 'p';
    const pid_t child = ::fork();
    if (child == 0) {
      forget_reclaimable_memory();
      reopen_scratch_memory();
      allow_scratch_memory(size + 100'000);
      auto* const childs = static_cast<char*>(allocate_scratch_memory(size));
      childs[0] = 'c';
      const bool is_right = parents[0] == 'p' && childs != parents;
      parents[0] = 'x';
      free_scratch_memory(parents);
      end(is_right);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    auto* const another = static_cast<char*>(allocate_scratch_memory(size)); // at the place of the child's
    end(status == 0 && parents[0] == 'p' && another[0] != 'c');
  };
  EXPECT_EXIT(check(), testing::ExitedWithCode(0), "");
}

TEST_F(Scratch_memory_DeathTest, says_which_folder_has_no_room) {
  const auto check = [&] {
    limit_size_of_files();
    open_scratch_memory(folder_, 0);
    try {
      allocate_scratch_memory(2'000'000);
    } catch (const No_room_for_scratch_memory&) {
      end(lack_of_room_for_scratch_memory().starts_with("--memory: the folder '" + folder_.string() + "' has no room"));
    }
    end(false);
  };
  EXPECT_EXIT(check(), testing::ExitedWithCode(0), "");
}

TEST_F(Scratch_memory_DeathTest, needs_a_folder) {
  EXPECT_THROW(open_scratch_memory(folder_ / "none", 0), Input_error);
}

} // namespace memory_limit_test

#endif
