// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/registration_cases.h"
#include "support/solids.h"
#include <equiaffine/registration/contradictions_of_meshes.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace contradictions_of_meshes_test {

using namespace equiaffine;
using namespace registration_cases;
using namespace solids;

TEST(Contradictions_of_meshes, they_are_the_parts_off_a_surface_that_goes_on) {
  const Solid low = prism(regular(60), 1), high = prism(regular(60), 2);
  const auto distance = 1e-3;
  const auto closed = contradictions_of_meshes(low.points, low.polygons, high.points, high.polygons, distance);
  EXPECT_TRUE(closed.are_closed);
  EXPECT_NEAR(closed.parts[0], .25, .01); // one of two caps with the area pi, beside a side of 2 pi
  EXPECT_NEAR(closed.parts[1], .5, .01);  // half of the side, and the cap
  EXPECT_NEAR(closed.inliers[0], .75, .01);
  EXPECT_NEAR(closed.inliers[1], .5, .01);
  Solid open = low;
  open.polygons.pop_back(), open.polygons.pop_back();
  const auto tube = contradictions_of_meshes(open.points, open.polygons, high.points, high.polygons, distance);
  EXPECT_FALSE(tube.are_closed);
  EXPECT_EQ(tube.parts[0], 0);
  EXPECT_LT(tube.parts[1], .01);
  for (auto& polygon : open.polygons) std::reverse(polygon.begin(), polygon.end());
  const auto inside_out = contradictions_of_meshes(open.points, open.polygons, high.points, high.polygons, distance);
  EXPECT_EQ(inside_out.parts, tube.parts);
}

TEST(Contradictions_of_meshes, sheets_as_far_away_as_a_piece_is_large_are_none) {
  Solid face = box(1, 1, 1), boxes = face;
  for (const Point_3& p : face.points) boxes.points.push_back(p + Kernel::Vector_3(0, 0, 3));
  for (auto polygon : face.polygons) {
    for (auto& v : polygon) v += face.points.size();
    boxes.polygons.push_back(polygon);
  }
  for (const auto& polygon : face.polygons) {
    Solid one = face;
    one.polygons = {polygon};
    const auto result = contradictions_of_meshes(one.points, one.polygons, boxes.points, boxes.polygons, 1e-3);
    EXPECT_EQ(result.parts[0], 0);
    EXPECT_EQ(result.parts[1], 0);
    EXPECT_NEAR(result.inliers[0], 1, .01);
  }
}

} // namespace contradictions_of_meshes_test
