// SPDX-License-Identifier: GPL-3.0-or-later
// What will take long or much memory is announced or asked for beforehand.
#include "system/expected_duration.h"
#include "system/memory_limit.h"
#include <equiaffine/base/Input_error.h>

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace expected_duration_test {

using namespace equiaffine;

TEST(Expected_duration, the_time_of_cells_follows_from_coarser_ones) {
  constexpr double n = 4096;
  for (const auto& [once, square, cubic] : std::vector<std::array<double, 3>>{
           {0, 0, 1e-6}, {0, 1e-4, 0}, {.8, 2e-5, 1e-6}, {.5, 0, 0}, {.1, 1e-9, 1e-9}, {0, 5e-4, 0}}) {
    const auto time = [=](double k) { return once + square * k * k + cubic * k * k * k; };
    std::vector<double> asked;
    const auto seconds = [&](double k) {
      asked.push_back(k);
      return time(k);
    };
    EXPECT_NEAR(expected_seconds(n, true, 0, seconds), time(n), 1e-6 * time(n))
        << once << ' ' << square << ' ' << cubic;
    if (cubic == 0) {
      EXPECT_NEAR(expected_seconds(n, false, 0, seconds), time(n), 1e-6 * time(n)) << once << ' ' << square;
    }
    for (const double k : asked) EXPECT_LE(k, n / 2) << "what is tried is coarse";
  }
}

TEST(Expected_duration, an_interruption_is_not_taken_for_work) {
  bool is_first = true;
  const auto seconds = [&](double k) { return 1e-6 * k * k + (k == 64 && std::exchange(is_first, false) ? .5 : 0); };
  EXPECT_NEAR(expected_seconds(1000, true, 0, seconds), 1, .1);
}

TEST(Expected_duration, what_takes_long_on_a_coarse_grid_is_not_tried_on_a_finer_one) {
  std::vector<double> asked;
  const auto seconds = [&](double k) {
    asked.push_back(k);
    return 1e-4 * k * k * k;
  };
  EXPECT_EQ(expected_seconds(1000, true, 0, seconds), 0);
  EXPECT_LE(asked.back(), 32);
}

TEST(Expected_duration, a_short_time_is_known_from_a_coarse_grid_alone) {
  std::vector<double> asked;
  const auto seconds = [&](double k) {
    asked.push_back(k);
    return .001 + 1e-6 * k * k;
  };
  const double bound = expected_seconds(1024, true, 60, seconds);
  EXPECT_GE(bound, seconds(1024));
  EXPECT_LT(bound, 60);
  EXPECT_EQ(asked, (std::vector<double>{16, 32, 64, 1024}));
  EXPECT_NEAR(expected_seconds(16384, true, 60, seconds), seconds(16384), 1e-6 * seconds(16384))
      << "that takes minutes";
}

TEST(Expected_duration, it_is_announced_in_a_line_of_its_own_with_what_takes_less) {
  std::ostringstream stream;
  {
    Progress progress(stream, false, std::chrono::hours(1));
    announce_duration("counting", "a smaller --resolution", 100, true, progress,
                      [](double) { FAIL() << "that is never long"; });
    announce_duration("counting", "a smaller --resolution", 300, true, progress,
                      [](double) { throw Input_error("too coarse"); });
    progress.announce("counting will take about 2 min 5 s");
  }
  EXPECT_EQ(stream.str(), "equiaffine: progress: counting will take about 2 min 5 s\n");
  EXPECT_EQ(Progress_report::time_text(125), "2 min 5 s");
  EXPECT_EQ(Progress_report::time_text(1e300), "1000000000 h 0 min");
}

TEST(Expected_duration, more_than_half_of_the_memory_needs_consent) {
  const double bytes_per_node = 16;
  const auto nodes = std::size_t(std::cbrt(.75 * physical_memory() / bytes_per_node));
  const std::array<std::size_t, 3> size = {nodes, nodes, nodes};
  EXPECT_NO_THROW(check_memory_of_volume(size, Memory_use::ALL));
  try {
    check_memory_of_volume(size, Memory_use::HALF);
    FAIL();
  } catch (const Input_error& error) {
    EXPECT_NE(std::string(error.what()).find("more than half of the"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("--yes"), std::string::npos) << error.what();
  }
  EXPECT_THROW(check_memory_of_volume({2 * nodes, nodes, nodes}, Memory_use::ALL), Input_error);
  EXPECT_NO_THROW(check_memory_of_volume({nodes / 2, nodes, nodes}, Memory_use::HALF));
}

} // namespace expected_duration_test
