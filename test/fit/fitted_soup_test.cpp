// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/function/Level_set_traits_3.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fitted_soup_test {

using namespace equiaffine;
using Point_3 = CGAL::Simple_cartesian<double>::Point_3;

/// The ellipsoid x^2 + y^2 / 2.25 + z^2 / 0.64 = 1 as an octahedron of 8 n^2 triangles, turned outwards.
struct Ellipsoid {
  std::vector<Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;

  Ellipsoid() {
    for (const int sx : {1, -1})
      for (const int sy : {1, -1})
        for (const int sz : {1, -1})
          for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
              const auto at = [&](int a, int b) { return position({sx * a, sy * b, sz * (n - a - b)}); };
              add(at(i, j), at(i + 1, j), at(i, j + 1), sx * sy * sz);
              if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), sx * sy * sz);
            }
  }

private:
  static constexpr int n = 9;

  void add(std::size_t a, std::size_t b, std::size_t c, int side) {
    if (side > 0) triangles.push_back({a, b, c});
    else triangles.push_back({a, c, b});
  }

  std::size_t position(const std::array<int, 3>& node) {
    const auto [place, is_new] = positions_.emplace(node, points.size());
    const double r = std::hypot(node[0], node[1], node[2]);
    if (is_new) points.emplace_back(node[0] / r, 1.5 * node[1] / r, 0.8 * node[2] / r);
    return place->second;
  }

  std::map<std::array<int, 3>, std::size_t> positions_;
};

std::vector<Fitted_structure_3<double>> of_mesh(const Ellipsoid& ellipsoid) {
  CGAL::Surface_mesh<Point_3> mesh;
  using Vertex = CGAL::Surface_mesh<Point_3>::Vertex_index;
  for (const auto& p : ellipsoid.points) mesh.add_vertex(p);
  for (const auto& [a, b, c] : ellipsoid.triangles)
    mesh.add_face(Vertex(unsigned(a)), Vertex(unsigned(b)), Vertex(unsigned(c)));
  return fitted_structures(mesh, {.scale = 0});
}

void expect_regular_and_outwards(const std::vector<Fitted_structure_3<double>>& structures) {
  for (const auto& s : structures) {
    EXPECT_EQ(s.structure.status, Point_status::REGULAR);
    EXPECT_LT(s.structure.affine.mean_curvature, 0);
  }
}

void expect_same(const std::vector<Fitted_structure_3<double>>& a, const std::vector<Fitted_structure_3<double>>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].structure.affine.gaussian_curvature, b[i].structure.affine.gaussian_curvature) << i;
    EXPECT_EQ(a[i].structure.euclidean.normal, b[i].structure.euclidean.normal) << i;
    EXPECT_EQ(a[i].scale, b[i].scale) << i;
  }
}

TEST(Fitted_soup, a_mesh_and_its_points_and_triangles_get_the_same_numbers) {
  const Ellipsoid ellipsoid;
  const auto structures = fitted_structures(ellipsoid.points, ellipsoid.triangles, {.scale = 0});
  expect_same(structures, of_mesh(ellipsoid));
  expect_regular_and_outwards(structures);
}

TEST(Fitted_soup, triangles_whose_orientations_contradict_are_turned_like_the_first_one) {
  Ellipsoid ellipsoid;
  for (std::size_t t = 1; t < ellipsoid.triangles.size(); t += 3)
    std::swap(ellipsoid.triangles[t][0], ellipsoid.triangles[t][1]);
  expect_regular_and_outwards(fitted_structures(ellipsoid.points, ellipsoid.triangles, {.scale = 0}));
}

TEST(Fitted_soup, equal_points_and_triangles_count_once_and_a_point_without_faces_is_outside) {
  Ellipsoid ellipsoid;
  const std::size_t size = ellipsoid.points.size();
  for (std::size_t i = 0; i < size; ++i) ellipsoid.points.push_back(ellipsoid.points[i]);
  for (std::size_t t = 0; t < ellipsoid.triangles.size(); t += 2) ellipsoid.triangles[t][0] += size;
  ellipsoid.triangles.push_back(ellipsoid.triangles.back());
  ellipsoid.triangles.push_back({0, 0, 1});
  ellipsoid.points.emplace_back(0, 0, 0.5);
  auto structures = fitted_structures(ellipsoid.points, ellipsoid.triangles, {.scale = 0});
  ASSERT_EQ(structures.size(), 2 * size + 1);
  EXPECT_EQ(structures.back().structure.status, Point_status::OUTSIDE);
  structures.pop_back();
  expect_regular_and_outwards(structures);
}

TEST(Fitted_soup, a_third_triangle_at_an_edge_does_no_harm) {
  Ellipsoid ellipsoid;
  ellipsoid.points.emplace_back(0, 0, 0);
  ellipsoid.triangles.push_back({0, 1, ellipsoid.points.size() - 1});
  auto structures = fitted_structures(ellipsoid.points, ellipsoid.triangles, {.scale = 0});
  EXPECT_EQ(structures.back().structure.status, Point_status::OUTSIDE);
  structures.pop_back();
  expect_regular_and_outwards(structures);
}

TEST(Fitted_soup, against_gives_the_structure_of_the_other_side) {
  const Ellipsoid ellipsoid;
  const auto along = fitted_structures(ellipsoid.points, ellipsoid.triangles, {.scale = 0});
  const auto against = fitted_structures(ellipsoid.points, ellipsoid.triangles, {.scale = 0},
                                         Orientation_of_level_set::AGAINST_GRADIENT);
  for (std::size_t i = 0; i < along.size(); ++i) {
    const auto &a = along[i].structure, &b = against[i].structure;
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(b.euclidean.normal[axis], -a.euclidean.normal[axis]);
    EXPECT_NEAR(b.affine.mean_curvature, -a.affine.mean_curvature, 1e-12);
    EXPECT_NEAR(b.affine.gaussian_curvature, a.affine.gaussian_curvature, 1e-12);
    EXPECT_EQ(along[i].scale, against[i].scale);
  }
}

TEST(Fitted_soup, the_deviation_is_that_of_the_noise_in_the_unit_of_the_data) {
  Ellipsoid ellipsoid;
  constexpr double unit = 1000, deviation = 0.002;
  for (std::size_t i = 0; i < ellipsoid.points.size(); ++i) { // the sign of the step changes as at random
    const auto& p = ellipsoid.points[i];
    const double factor = unit * (1 + ((i * 2654435761U >> 7) % 2 == 0 ? deviation : -deviation));
    ellipsoid.points[i] = {factor * p.x(), factor * p.y(), factor * p.z()};
  }
  auto structures = fitted_structures(ellipsoid.points, ellipsoid.triangles, {.scale = 0});
  const auto median = structures.begin() + std::ptrdiff_t(structures.size() / 2);
  std::nth_element(structures.begin(), median, structures.end(),
                   [](const auto& a, const auto& b) { return a.deviation < b.deviation; });
  EXPECT_GT(median->deviation, unit * deviation / 2);
  EXPECT_LT(median->deviation, unit * deviation * 2);
}

TEST(Fitted_soup, polygons_have_positions_of_points) {
  const Ellipsoid ellipsoid;
  const std::vector<std::array<std::size_t, 3>> triangles = {{0, 1, ellipsoid.points.size()}};
  EXPECT_THROW(fitted_structures(ellipsoid.points, triangles, {.scale = 0}), std::invalid_argument);
  std::vector<Point_3> points = ellipsoid.points;
  points[3] = {0, 0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_THROW(fitted_structures(points, ellipsoid.triangles, {.scale = 0}), std::invalid_argument);
}

TEST(Fitted_soup, nothing_and_little_have_no_fit) {
  EXPECT_TRUE(fitted_structures(std::vector<Point_3>(), std::vector<std::array<int, 3>>()).empty());
  const std::vector<Point_3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const auto& s : fitted_structures(points, std::vector<std::array<int, 3>>{{0, 1, 2}}, {.scale = 0}))
    EXPECT_EQ(s.structure.status, Point_status::OUTSIDE);
  EXPECT_EQ(fitted_structures(points, {.scale = 0}).at(0).structure.status, Point_status::OUTSIDE);
}

} // namespace fitted_soup_test
