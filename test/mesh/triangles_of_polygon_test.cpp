// SPDX-License-Identifier: GPL-3.0-or-later
// Polygons that are not convex are cut into triangles within them, whichever corner comes first.
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace triangles_of_polygon_test {

using namespace equiaffine;
using Points = std::vector<Eigen::Vector3d>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Points in_plane(const std::vector<std::array<double, 2>>& corners) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Points points;
  for (const auto& [x, y] : corners) points.push_back(turn * Eigen::Vector3d(x, y, 5));
  return points;
}

std::vector<std::uint32_t> positions(const Points& points, std::size_t first = 0) {
  std::vector<std::uint32_t> polygon(points.size());
  std::iota(polygon.begin(), polygon.end(), 0u);
  std::rotate(polygon.begin(), polygon.begin() + std::ptrdiff_t(first), polygon.end());
  return polygon;
}

Triangles triangles_of(const Points& points, const std::vector<std::uint32_t>& polygon) {
  Triangles result;
  add_triangles_of_polygon(points, polygon, result);
  return result;
}

Eigen::Vector3d double_area(const Points& points, const std::array<std::uint32_t, 3>& t) {
  return (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

/// The areas of triangles within a polygon, which do not overlap, add up to its own.
void expect_cut(const std::vector<std::array<double, 2>>& corners, double area) {
  const Points points = in_plane(corners);
  for (std::size_t first = 0; first < points.size(); ++first) {
    const Triangles triangles = triangles_of(points, positions(points, first));
    EXPECT_EQ(triangles.size(), points.size() - 2);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double absolute = 0;
    for (const auto& t : triangles) {
      sum += double_area(points, t) / 2;
      absolute += double_area(points, t).norm() / 2;
    }
    EXPECT_NEAR(sum.norm(), area, 1e-12) << first;
    EXPECT_NEAR(absolute, area, 1e-12) << "a triangle leaves the polygon from corner " << first;
  }
}

TEST(Triangles_of_polygon, polygons_that_are_not_convex_are_covered_once_from_every_corner) {
  expect_cut({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, 4);                                  // an L
  expect_cut({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 2}, {2, 2}, {2, 1}, {0, 1}}, 7);                  // a C
  expect_cut({{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {2, 1}, {2, 3}, {1, 3}, {1, 1}, {0, 1}}, 8);  // a comb
  expect_cut({{0, 0}, {5, 0}, {5, 4}, {1, 4}, {1, 2}, {3, 2}, {3, 3}, {4, 3}, {4, 1}, {0, 1}}, 13); // a spiral
  expect_cut({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {1, 3}, {0, 3}, {0, 1.5}}, 4);        // with flat corners
}

TEST(Triangles_of_polygon, a_slit_to_a_hole_is_no_obstacle) {
  expect_cut({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}, 12);
}

TEST(Triangles_of_polygon, convex_polygons_are_the_fan_around_their_first_corner) {
  const Points points = in_plane({{0, 0}, {2, 0}, {3, 1}, {2, 2}, {0, 2}});
  EXPECT_EQ(triangles_of(points, {1, 2, 3, 4, 0}), (Triangles{{1, 2, 3}, {1, 3, 4}, {1, 4, 0}}));
}

TEST(Triangles_of_polygon, what_is_no_simple_polygon_has_a_fan_too) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Triangles fan = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(triangles_of(in_plane({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), {0, 1, 2, 3}), fan);
  EXPECT_EQ(triangles_of(Points(4, Eigen::Vector3d(1, 2, 3)), {0, 1, 2, 3}), fan);
  EXPECT_EQ(triangles_of(Points(4, Eigen::Vector3d(1, infinity, 3)), {0, 1, 2, 3}), fan);
  EXPECT_TRUE(triangles_of(Points(4), {0, 1}).empty());
}

} // namespace triangles_of_polygon_test
