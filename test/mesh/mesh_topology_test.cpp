// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/mesh/mesh_topology.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace mesh_topology_test {

using equiaffine::mesh_topology;
using equiaffine::Mesh_topology;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const Triangles tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

Triangles shifted(Triangles triangles, std::uint32_t offset) {
  for (auto& triangle : triangles)
    for (auto& v : triangle) v += offset;
  return triangles;
}

Triangles joined(Triangles first, const Triangles& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// A grid of n x n points with both directions closed.
Triangles torus(std::uint32_t n) {
  Triangles triangles;
  const auto index = [n](std::uint32_t i, std::uint32_t j) { return i % n * n + j % n; };
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  return triangles;
}

void expect(const Mesh_topology& topology, bool is_manifold, std::size_t components,
            std::ptrdiff_t euler_characteristic, std::size_t boundary_edges) {
  EXPECT_EQ(topology.is_manifold, is_manifold);
  EXPECT_EQ(topology.components, components);
  EXPECT_EQ(topology.euler_characteristic, euler_characteristic);
  EXPECT_EQ(topology.boundary_edges, boundary_edges);
}

TEST(Mesh_topology, a_tetrahedron_is_a_sphere) {
  const Mesh_topology topology = mesh_topology(tetrahedron, 4);
  expect(topology, true, 1, 2, 0);
  EXPECT_EQ(topology.edges, 6U);
}

TEST(Mesh_topology, a_torus_has_euler_characteristic_zero) { expect(mesh_topology(torus(5), 25), true, 1, 0, 0); }

TEST(Mesh_topology, disjoint_surfaces_add_up) {
  expect(mesh_topology(joined(tetrahedron, shifted(torus(4), 4)), 20), true, 2, 2, 0);
}

TEST(Mesh_topology, a_removed_triangle_leaves_three_boundary_edges) {
  Triangles open = tetrahedron;
  open.pop_back();
  expect(mesh_topology(open, 4), true, 1, 1, 3);
}

TEST(Mesh_topology, a_strip_of_two_triangles_has_four_boundary_edges) {
  expect(mesh_topology(Triangles{{0, 1, 2}, {2, 1, 3}}, 4), true, 1, 1, 4);
}

TEST(Mesh_topology, neighbors_of_opposite_orientation_are_not_a_manifold) {
  expect(mesh_topology(Triangles{{0, 1, 2}, {1, 2, 3}}, 4), false, 1, 1, 4);
}

TEST(Mesh_topology, three_triangles_at_an_edge_are_not_a_manifold) {
  expect(mesh_topology(Triangles{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5), false, 1, 1, 6);
}

TEST(Mesh_topology, two_surfaces_that_share_a_point_are_not_a_manifold) {
  Triangles two = joined(tetrahedron, shifted(tetrahedron, 3)); // point 3 is in both
  expect(mesh_topology(two, 7), false, 1, 3, 0);
  Triangles fans = {{0, 1, 2}, {0, 3, 4}};
  expect(mesh_topology(fans, 5), false, 1, 1, 6);
}

TEST(Mesh_topology, a_point_in_no_triangle_is_a_component_and_not_a_manifold) {
  expect(mesh_topology(tetrahedron, 5), false, 2, 3, 0);
}

TEST(Mesh_topology, a_repeated_index_is_not_a_manifold) {
  EXPECT_FALSE(mesh_topology(joined(tetrahedron, {{0, 0, 1}}), 4).is_manifold);
  EXPECT_FALSE(mesh_topology(joined(tetrahedron, {{0, 1, 1}}), 4).is_manifold);
}

TEST(Mesh_topology, a_triangle_given_twice_is_not_a_manifold) {
  EXPECT_FALSE(mesh_topology(joined(tetrahedron, {tetrahedron[0]}), 4).is_manifold);
}

TEST(Mesh_topology, nothing_is_empty) { expect(mesh_topology(Triangles{}, 0), true, 0, 0, 0); }

} // namespace mesh_topology_test
