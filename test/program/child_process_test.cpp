// SPDX-License-Identifier: GPL-3.0-or-later
#include "system/memory_limit.h"
#include "system/process.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/Progress_observer.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <functional>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace child_process_test {

using equiaffine::Child_failure;
using equiaffine::Input_error;
using equiaffine::Progress_observer;
using equiaffine::run_in_child;
using equiaffine::Shared_memory;

constexpr double megabyte = 1 << 20;
constexpr equiaffine::Child_limits generous = {60, 1024 * megabyte};

std::string failure_of(const std::function<void()>& task, const equiaffine::Child_limits& limits = generous) {
  try {
    run_in_child(task, limits);
  } catch (const Child_failure& failure) {
    return failure.what();
  }
  return "no failure";
}

TEST(Program_child_process, writes_to_shared_memory_and_changes_nothing_else) {
  Shared_memory memory;
  std::string text = "old";
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  run_in_child(
      [&] {
        text = "new";
        std::cout << "lost" << std::endl;
        std::cerr << "lost" << std::endl;
        std::memcpy(memory.allocate(4), "abc", 4);
        std::memcpy(memory.allocate(8), "12345", 6);
      },
      generous);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(text, "old");
  EXPECT_STREQ(reinterpret_cast<const char*>(memory.data()), "12345");
}

TEST(Program_child_process, leaves_no_memory_if_it_allocates_none) {
  Shared_memory memory;
  run_in_child([] {}, generous);
  EXPECT_EQ(memory.data(), nullptr);
}

TEST(Program_child_process, hands_on_errors_of_input_with_their_excerpts) {
  try {
    run_in_child([] { throw Input_error("what", "excerpt\n^"); }, generous);
    FAIL() << "no error";
  } catch (const Input_error& error) {
    EXPECT_STREQ(error.what(), "what");
    EXPECT_EQ(error.excerpt(), "excerpt\n^");
  }
}

TEST(Program_child_process, fails_if_it_crashes_or_throws) {
  EXPECT_EQ(failure_of([] { std::raise(SIGSEGV); }), "crashed (Segmentation fault)");
  EXPECT_EQ(failure_of([] { std::abort(); }), "crashed (Aborted)");
  EXPECT_EQ(failure_of([] { throw std::runtime_error("reason"); }), "failed (reason)");
  EXPECT_EQ(failure_of([] { throw 1; }), "failed");
  EXPECT_EQ(failure_of([] { std::_Exit(0); }), "failed");
}

TEST(Program_child_process, fails_if_it_takes_too_long) {
  volatile bool is_endless = true;
  const auto compute = [&] {
    while (is_endless) {
    }
  };
  EXPECT_EQ(failure_of(compute, {1, megabyte}), "took longer than 1 s");
}

TEST(Program_child_process, is_ended_by_an_observer_of_its_parent) {
  struct Enough {};
  const Progress_observer observer([](const Progress_observer::Stage&) { throw Enough(); });
  EXPECT_THROW(run_in_child([] { ::pause(); }, generous), Enough);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
}

TEST(Program_child_process, is_not_seen_from_within_by_an_observer_of_its_parent) {
  const Progress_observer observer(
      [parent = ::getpid()](const Progress_observer::Stage&) {
        if (::getpid() != parent) throw std::runtime_error("seen");
      },
      std::chrono::milliseconds(0));
  EXPECT_EQ(failure_of([] { Progress_observer::step(); }), "no failure");
}

TEST(Program_child_process, leaves_Control_C_to_its_parent) {
  EXPECT_EQ(failure_of([] { std::raise(SIGINT); }), "no failure");
}

TEST(Program_child_process, has_no_more_memory_than_it_is_allowed) {
  const auto take = [](double bytes) {
    std::vector<char> block(std::size_t(bytes), 'x');
    if (std::count(block.begin(), block.end(), 'x') != std::ptrdiff_t(block.size())) throw std::logic_error("lost");
  };
  EXPECT_NO_THROW(run_in_child([&] { take(100 * megabyte); }, {60, 300 * megabyte}));
  EXPECT_THROW(run_in_child([&] { take(400 * megabyte); }, {60, 300 * megabyte}), std::bad_alloc);
  const auto take_what_is_allowed_later = [&] {
    equiaffine::allow_memory(600 * megabyte);
    take(400 * megabyte);
  };
  EXPECT_NO_THROW(run_in_child(take_what_is_allowed_later, {60, 300 * megabyte}));
}

TEST(Program_child_process, has_no_more_memory_than_the_computer) {
  const double more = 2 * equiaffine::physical_memory();
  const auto expect_less = [more](bool is_asked_later) {
    if (is_asked_later) equiaffine::allow_memory(2 * more);
    struct rlimit limit;
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || double(limit.rlim_cur) >= more) throw std::logic_error("more");
  };
  EXPECT_NO_THROW(run_in_child([&] { expect_less(false); }, {60, 2 * more}));
  EXPECT_NO_THROW(run_in_child([&] { expect_less(true); }, {60, megabyte}));
}

} // namespace child_process_test
