// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/displays.h"
#include <equiaffine/mesh/mesh_topology.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace decimate_test {

using equiaffine::Kernel;

constexpr std::uint32_t side = 100;

/// A wavy square with the number of each vertex as its attribute.
equiaffine::Displayed_mesh wavy_square(double scale) {
  equiaffine::Displayed_mesh square;
  square.attributes.columns.push_back({"number", {}});
  square.attributes.status.emplace();
  for (std::uint32_t j = 0; j < side; ++j)
    for (std::uint32_t i = 0; i < side; ++i) {
      square.mesh.points.emplace_back(scale * i, scale * j, scale * 10 * std::sin(0.1 * i));
      square.attributes.columns[0].values.push_back(side * j + i);
      square.attributes.status->push_back(i < side / 2 ? equiaffine::Point_status::REGULAR
                                                       : equiaffine::Point_status::PARABOLIC);
    }
  for (std::uint32_t j = 0; j + 1 < side; ++j)
    for (std::uint32_t i = 0; i + 1 < side; ++i) {
      const std::uint32_t v = j * side + i;
      square.mesh.triangles.push_back({v, v + 1, v + side});
      square.mesh.triangles.push_back({v + 1, v + side + 1, v + side});
    }
  return square;
}

TEST(Program_decimate, a_coarse_mesh_has_some_of_the_vertices_with_their_numbers) {
  for (const double scale : {1.0, 1e-200, 1e150}) {
    const auto [mesh, attributes] = wavy_square(scale);
    constexpr std::size_t most = 2000;
    const auto [coarse, numbers] = equiaffine::decimate(mesh, attributes, most);
    EXPECT_LE(coarse.triangles.size(), most);
    EXPECT_GE(coarse.triangles.size(), most / 3);
    ASSERT_TRUE(numbers.has_length(coarse.points.size()));
    for (std::size_t v = 0; v < coarse.points.size(); ++v) {
      const auto number = std::size_t(numbers.columns[0].values[v]);
      EXPECT_EQ(coarse.points[v], mesh.points[number]);
      EXPECT_EQ((*numbers.status)[v], (*attributes.status)[number]);
    }
    const auto topology = equiaffine::mesh_topology(coarse.triangles, coarse.points.size());
    EXPECT_EQ(topology.components, 1u);
    double area = 0; // seen from above
    for (const auto& [a, b, c] : coarse.triangles) {
      const auto normal = CGAL::cross_product(coarse.points[b] - coarse.points[a], coarse.points[c] - coarse.points[a]);
      area += normal.z() / scale / scale / 2;
    }
    if (scale == 1) {
      EXPECT_NEAR(area, 99 * 99, 99 * 20) << "triangles keep their side";
    }
  }
}

constexpr std::size_t most_triangles = 2000;

/// The bounds of x, y and z of a mesh.
CGAL::Bbox_3 box_of(const equiaffine::Indexed_triangle_mesh_3<Kernel>& mesh) {
  CGAL::Bbox_3 box;
  for (const auto& point : mesh.points) box += point.bbox();
  return box;
}

TEST(Program_decimate, leaves_out_triangles_with_a_corner_that_is_not_finite) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    auto [mesh, attributes] = wavy_square(1);
    const std::uint32_t v = side * side / 2 + side / 2;
    mesh.points[v] = {mesh.points[v].x(), bad, mesh.points[v].z()};
    const auto [coarse, numbers] = equiaffine::decimate(mesh, attributes, most_triangles);
    EXPECT_LE(coarse.triangles.size(), most_triangles);
    EXPECT_GE(coarse.triangles.size(), most_triangles / 3);
    const CGAL::Bbox_3 box = box_of(coarse);
    EXPECT_GT(box.y_span(), 90);
    EXPECT_LT(box.y_span(), 100);
    for (const double number : numbers.columns[0].values) EXPECT_NE(number, v);
  }
}

TEST(Program_decimate, keeps_most_of_a_mesh_beside_a_vertex_far_away) {
  const auto [square, numbers_of_square] = wavy_square(1);
  for (const bool has_triangle : {false, true}) {
    equiaffine::Displayed_mesh stray = {square, numbers_of_square};
    stray.mesh.points.emplace_back(1e5, 1e5, 1e5);
    stray.attributes.columns[0].values.push_back(-1);
    stray.attributes.status->push_back(equiaffine::Point_status::REGULAR);
    if (has_triangle) stray.mesh.triangles.push_back({0, side - 1, side * side});
    const auto [coarse, numbers] = equiaffine::decimate(stray.mesh, stray.attributes, most_triangles);
    EXPECT_LE(coarse.triangles.size(), most_triangles);
    EXPECT_GE(coarse.triangles.size(), most_triangles / 3) << has_triangle;
    EXPECT_EQ(box_of(coarse).x_span() > 1000, has_triangle);
  }
}

TEST(Program_decimate, nothing_is_left_of_what_has_no_area_or_no_finite_corner) {
  for (const double coordinate : {7.0, 1e308, std::nan("")}) {
    equiaffine::Displayed_mesh point;
    point.mesh.points.assign(3, {coordinate, -coordinate, 0});
    point.mesh.triangles.assign(10, {0, 1, 2});
    const auto [coarse, numbers] = equiaffine::decimate(point.mesh, point.attributes, 5);
    EXPECT_TRUE(coarse.triangles.empty());
    EXPECT_TRUE(coarse.points.empty());
  }
}

TEST(Program_decimate, takes_coordinates_up_to_the_largest_numbers) {
  const auto [mesh, attributes] = wavy_square(1);
  equiaffine::Displayed_mesh huge = {mesh, attributes};
  for (auto& p : huge.mesh.points) p = {(p.x() - 50) * 0x1p1017, (p.y() - 50) * 0x1p1017, p.z() * 0x1p1017};
  EXPECT_EQ(equiaffine::decimate(huge.mesh, huge.attributes, most_triangles).mesh.triangles,
            equiaffine::decimate(mesh, attributes, most_triangles).mesh.triangles);
}

} // namespace decimate_test
