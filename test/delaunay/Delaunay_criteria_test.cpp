// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/delaunay/Delaunay_criteria.h>

#include <gtest/gtest.h>

#include <cmath>

namespace Delaunay_criteria_test {

using namespace equiaffine;

TEST(Delaunay_criteria, lengths_of_zero_get_their_defaults) {
  const Clip_domain_3 box(CGAL::Bbox_3(0, 0, 0, 2, 3, 6)), ball({0, 0, 0}, 2); // diagonals 7 and 4 sqrt(3)
  const auto defaults = Delaunay_criteria().completed(box);
  EXPECT_EQ(defaults.angle, 30);
  EXPECT_DOUBLE_EQ(defaults.radius, 0.14);
  EXPECT_DOUBLE_EQ(defaults.distance, 0.014);
  EXPECT_DOUBLE_EQ(Delaunay_criteria().completed(ball).radius, 4 * std::sqrt(3.0) / 50);
  EXPECT_DOUBLE_EQ((Delaunay_criteria{20, 0.5, 0}.completed(box).distance), 0.05);
}

TEST(Delaunay_criteria, lengths_that_are_given_are_kept) {
  const auto criteria = Delaunay_criteria{20, 0.5, 0.25}.completed(Clip_domain_3(CGAL::Bbox_3(0, 0, 0, 1, 1, 1)));
  EXPECT_EQ(criteria.angle, 20);
  EXPECT_EQ(criteria.radius, 0.5);
  EXPECT_EQ(criteria.distance, 0.25);
}

} // namespace Delaunay_criteria_test
