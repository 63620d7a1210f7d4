// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/attributes/Fit_statistics.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace Fit_statistics_test {

using namespace equiaffine;
using Structure = Fitted_structure_3<double>;

/// A regular point with K = 1, whose error, and what noise makes of it, are these parts of K.
Structure with_error(double error, double noise) {
  Structure s{};
  s.structure.status = Point_status::REGULAR;
  s.structure.affine.gaussian_curvature = 1;
  s.error.affine_gaussian_curvature = error;
  s.noise.affine_gaussian_curvature = noise;
  s.scale = s.deviation = .3;
  return s;
}

Structure without_fit() {
  Structure s = with_error(std::nan(""), std::nan(""));
  s.structure.status = Point_status::OUTSIDE;
  s.scale = s.deviation = std::nan("");
  return s;
}

TEST(Fit_statistics, count_the_points_where_a_number_is_known) {
  const std::vector<Structure> structures = {with_error(.05, 0), with_error(.15, 0), with_error(.3, 0), without_fit()};
  const Fit_statistics statistics = statistics_of_fit(structures);
  EXPECT_EQ(statistics.known_of("affine_gaussian_curvature"), (Fit_statistics::Parts{.25, .5, .75}));
  EXPECT_EQ(statistics.without_fit, .25);
  EXPECT_EQ(statistics.scales, (std::array{.3, .3, .3}));
  EXPECT_EQ(statistics.noise, .3);
  EXPECT_FALSE(statistics.scale);
  EXPECT_EQ(first_known(statistics), "affine_gaussian_curvature");
}

TEST(Fit_statistics, reasons_of_doubt_are_those_of_a_tenth_of_the_unknown_points) {
  std::vector<Structure> structures(40, with_error(.8, .8)); // by noise
  structures.resize(60, with_error(.7, .1));                 // by detail
  structures.resize(65, without_fit());
  structures.resize(100, with_error(.1, .1));
  const auto doubts = doubts_of(statistics_of_fit(structures));
  ASSERT_EQ(doubts.size(), 2U);
  EXPECT_EQ(doubts[0].reason, Fit_doubt::NOISE);
  EXPECT_EQ(doubts[0].part, .4);
  EXPECT_EQ(doubts[1].reason, Fit_doubt::DETAIL);
  EXPECT_EQ(doubts[1].part, .2);
  EXPECT_TRUE(doubts_of(statistics_of_fit(structures), false).empty()) << "of what needs two derivatives";
  structures.resize(200, with_error(.1, .1));
  EXPECT_TRUE(doubts_of(statistics_of_fit(structures)).empty()) << "K is known at more points";
}

} // namespace Fit_statistics_test
