// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/decimate.h"
#include <equiaffine/mesh_topology.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace {

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

} // namespace
