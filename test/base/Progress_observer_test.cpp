// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/base/internal/parallel_for.h>

#include <CGAL/tags.h>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>
#include <vector>

namespace Progress_observer_test {

using equiaffine::parallel_for;
using equiaffine::Progress_observer;
using Stage = Progress_observer::Stage;
constexpr Progress_observer::Clock::duration at_every_step{};

struct Cancelled {};

/// Some work that takes a tenth of a millisecond.
void work() { std::this_thread::sleep_for(std::chrono::microseconds(100)); }

template <class Tag>
class Progress_observer_of : public testing::Test {};
using Tags = testing::Types<CGAL::Sequential_tag, CGAL::Parallel_if_available_tag>;
TYPED_TEST_SUITE(Progress_observer_of, Tags);

TYPED_TEST(Progress_observer_of, sees_each_outer_loop_as_a_stage_in_its_own_thread) {
  std::vector<Stage> seen;
  const auto self = std::this_thread::get_id();
  const Progress_observer observer(
      [&](const Stage& stage) {
        EXPECT_EQ(std::this_thread::get_id(), self);
        seen.push_back(stage);
      },
      at_every_step);
  for (const std::size_t size : {40, 70})
    parallel_for<TypeParam>(0, size, [](std::size_t) {
      work();
      parallel_for<TypeParam>(0, 3, [](std::size_t) {});
    });
  ASSERT_GE(seen.size(), 2u);
  for (std::size_t n = 0; n < seen.size(); ++n) {
    EXPECT_EQ(seen[n].total, seen[n].number == 1 ? 40u : 70u);
    EXPECT_LT(seen[n].done, seen[n].total);
    if (n == 0) continue;
    EXPECT_GE(seen[n].number, seen[n - 1].number);
    if (seen[n].number == seen[n - 1].number) {
      EXPECT_GE(seen[n].done, seen[n - 1].done);
    }
  }
  EXPECT_EQ(seen.front().number, 1u);
  EXPECT_EQ(seen.back().number, 2u);
}

TYPED_TEST(Progress_observer_of, ends_all_threads_by_its_exception) {
  for (const bool is_nested : {false, true}) {
    std::atomic<std::size_t> steps = 0;
    const auto step = [&](std::size_t) {
      work();
      ++steps;
    };
    const auto compute = [&] {
      const Progress_observer observer([](const Stage&) { throw Cancelled(); }, std::chrono::milliseconds(2));
      if (is_nested) parallel_for<TypeParam>(0, 100, [&](std::size_t) { parallel_for<TypeParam>(0, 100, step); });
      else parallel_for<TypeParam>(0, 10000, step);
    };
    EXPECT_THROW(compute(), Cancelled);
    EXPECT_LT(steps, 5000u);
    const std::size_t before = steps;
    work();
    EXPECT_EQ(steps, before) << "no thread goes on";
  }
}

TYPED_TEST(Progress_observer_of, throws_again_where_its_exception_was_swallowed) {
  const Progress_observer observer([](const Stage&) { throw Cancelled(); }, at_every_step);
  EXPECT_THROW(parallel_for<TypeParam>(0, 10, [](std::size_t) { work(); }), Cancelled);
  EXPECT_THROW(parallel_for<TypeParam>(0, 10, [](std::size_t) { work(); }), Cancelled);
  EXPECT_THROW(Progress_observer::step(), Cancelled);
}

TEST(Progress_observer, sees_nothing_before_its_interval) {
  const Progress_observer observer([](const Stage&) { FAIL(); }, std::chrono::hours(1));
  parallel_for<CGAL::Sequential_tag>(0, 100, [](std::size_t) {});
  Progress_observer::step();
}

TEST(Progress_observer, may_use_the_library_itself) {
  int calls = 0, steps = 0;
  const Progress_observer observer(
      [&](const Stage&) {
        ++calls;
        parallel_for<CGAL::Parallel_if_available_tag>(0, 3, [](std::size_t) { Progress_observer::step(); });
      },
      at_every_step);
  parallel_for<CGAL::Sequential_tag>(0, 5, [&](std::size_t) { ++steps; });
  EXPECT_EQ(calls, 5);
  EXPECT_EQ(steps, 5);
}

TEST(Progress_observer, takes_any_interval) {
  const Progress_observer observer([](const Stage&) { FAIL(); }, Progress_observer::Clock::duration::max());
  Progress_observer::step();
}

TEST(Progress_observer, hides_those_before_it_while_it_lives) {
  int first = 0, second = 0;
  const auto compute = [] { parallel_for<CGAL::Sequential_tag>(0, 5, [](std::size_t) {}); };
  {
    const Progress_observer outer([&](const Stage&) { ++first; }, at_every_step);
    {
      const Progress_observer inner([&](const Stage&) { ++second; }, at_every_step);
      compute();
    }
    EXPECT_EQ(first, 0);
    EXPECT_EQ(second, 5);
    compute();
  }
  compute();
  EXPECT_EQ(first, 5);
  EXPECT_EQ(second, 5);
}

TEST(Progress_observer, sees_nothing_of_other_threads) {
  const Progress_observer observer([](const Stage&) { FAIL(); }, at_every_step);
  std::thread([] { parallel_for<CGAL::Sequential_tag>(0, 5, [](std::size_t) {}); }).join();
}

} // namespace Progress_observer_test
