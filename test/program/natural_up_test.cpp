// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/draw_surface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace natural_up_test {

using namespace equiaffine;
using Up = std::array<double, 3>;

const Up y = {0, 1, 0}, z = {0, 0, 1};

/// A cone whose axis has that number, on its base.
std::vector<Kernel::Point_3> cone(int axis) {
  std::vector<Kernel::Point_3> points;
  for (int i = 0; i <= 100; ++i)
    for (int k = 0; k < 40; ++k) {
      const double radius = 1 - i / 100., angle = 6.283185307179586 * k / 40;
      std::array<double, 3> p{};
      p[std::size_t(axis)] = i / 40.;
      p[std::size_t((axis + 1) % 3)] = radius * std::cos(angle);
      p[std::size_t((axis + 2) % 3)] = radius * std::sin(angle);
      points.emplace_back(p[0], p[1], p[2]);
    }
  return points;
}

TEST(Program_natural_up, a_shape_stands_on_its_foot) {
  EXPECT_EQ(natural_up(cone(2)), z);
  EXPECT_EQ(natural_up(cone(1)), y);
}

TEST(Program_natural_up, y_is_up_where_no_foot_tells) {
  EXPECT_EQ(natural_up(cone(0)), y);
  EXPECT_EQ(natural_up({}), y);
  EXPECT_EQ(natural_up({{0, 0, 0}, {0, 0, 1}}), y) << "a box without area";
}

} // namespace natural_up_test
