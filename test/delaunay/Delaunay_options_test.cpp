// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/delaunay/Delaunay_options.h>

#include <gtest/gtest.h>

#include <cmath>

namespace Delaunay_options_test {

using namespace equiaffine;

const CGAL::Bbox_3 box(0, 0, 0, 2, 3, 6); // its diagonal is 7

TEST(Delaunay_options, lengths_without_a_value_get_their_defaults) {
  const auto defaults = Delaunay_options().completed(box);
  EXPECT_EQ(defaults.angle, 30);
  EXPECT_DOUBLE_EQ(*defaults.radius, 0.14);
  EXPECT_DOUBLE_EQ(*defaults.distance, 0.014);
  EXPECT_DOUBLE_EQ(*Delaunay_options{.radius = 0.5}.completed(box).distance, 0.05);
}

TEST(Delaunay_options, the_box_of_a_domain_decides_the_radius_and_that_of_the_function_otherwise) {
  const Clip_domain_3 ball({0, 0, 0}, 2); // the diagonal of its box is 4 sqrt(3)
  EXPECT_DOUBLE_EQ(*Delaunay_options{.clip = ball}.completed(box).radius, 4 * std::sqrt(3.0) / 50);
  EXPECT_DOUBLE_EQ(*Delaunay_options{.clip = Clip_shape::BALL}.completed(box).radius, 0.14);
}

TEST(Delaunay_options, lengths_that_are_given_are_kept) {
  const auto options = Delaunay_options{.angle = 20, .radius = 0.5, .distance = 0.25}.completed(box);
  EXPECT_EQ(options.angle, 20);
  EXPECT_EQ(options.radius, 0.5);
  EXPECT_EQ(options.distance, 0.25);
}

TEST(Delaunay_options, a_shape_is_the_box_or_the_largest_ball_in_it) {
  EXPECT_EQ(clip_domain(Clip_shape::BOX, box).bbox(), box);
  EXPECT_FALSE(clip_domain(Clip_shape::BOX, box).is_ball());
  const auto ball = clip_domain(Clip_shape::BALL, box);
  EXPECT_TRUE(ball.is_ball());
  EXPECT_EQ(ball.radius(), 1);
  EXPECT_EQ(ball.center()[2], 3);
}

} // namespace Delaunay_options_test
