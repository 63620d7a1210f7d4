// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/volume/internal/bspline.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bspline_test {

using equiaffine::bspline;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <int Degree>
void expect_partition_of_unity() {
  for (double t = 0; t < 1; t += 1. / 64) {
    double sum = 0;
    for (int shift = -Degree; shift <= Degree; ++shift) sum += bspline<Degree>(t - shift);
    EXPECT_NEAR(sum, 1, 20 * epsilon) << "degree " << Degree << ", t = " << t;
  }
}

TEST(Bspline, values_at_integers_are_the_known_fractions) {
  EXPECT_NEAR(bspline<5>(0.), 66 / 120., epsilon);
  EXPECT_NEAR(bspline<5>(1.), 26 / 120., epsilon);
  EXPECT_NEAR(bspline<5>(-2.), 1 / 120., epsilon);
  EXPECT_NEAR(bspline<7>(0.), 2416 / 5040., epsilon);
  EXPECT_NEAR(bspline<7>(-3.), 1 / 5040., epsilon);
}

TEST(Bspline, shifts_sum_to_one) {
  expect_partition_of_unity<5>();
  expect_partition_of_unity<7>();
  expect_partition_of_unity<9>();
}

TEST(Bspline, it_is_even_and_vanishes_beyond_its_knots) {
  for (double t = 0; t < 4; t += 1. / 64) EXPECT_NEAR(bspline<7>(t), bspline<7>(-t), epsilon) << t;
  EXPECT_EQ(bspline<7>(4.25), 0);
  EXPECT_EQ(bspline<7>(-4.25), 0);
  EXPECT_GT(bspline<7>(3.75), 0);
}

} // namespace bspline_test
