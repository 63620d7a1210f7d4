// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/marching_cubes/internal/zero_area_repair.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <vector>

namespace zero_area_repair_test {

using namespace equiaffine;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Points = std::vector<std::array<double, 3>>;

struct Result {
  Mesh_topology topology; ///< of the triangles that are left
  std::size_t triangles = 0;
  Isosurface_repairs repairs;
};

/// The outcome of a repair in which every vertex moves in a direction of its own, but all in the same one in early
/// rounds.
Result repaired(Triangles triangles, Points points, int early_rounds = 0) {
  std::vector<std::size_t> suspects(triangles.size());
  std::iota(suspects.begin(), suspects.end(), std::size_t(0));
  const auto at = [&](std::size_t v) { return points[v]; };
  const auto nudge = [&](std::size_t v, int round) {
    for (std::size_t a = 0; a < 3; ++a)
      points[v][a] += 1e-7 * std::sin(round < early_rounds ? 1.0 : double(1 + 3 * v + a));
  };
  const std::span all(triangles);
  const auto is_at_cut = [](std::size_t) { return false; };
  const Isosurface_repairs repairs = internal::Zero_area_repair(all, suspects, at, nudge, is_at_cut).run();
  std::erase_if(triangles, [](const auto& t) { return t[0] == t[1]; });
  std::map<std::uint32_t, std::uint32_t> number;
  for (auto& t : triangles)
    for (auto& v : t) v = number.try_emplace(v, std::uint32_t(number.size())).first->second;
  return {mesh_topology(triangles, number.size()), triangles.size(), repairs};
}

void expect_unchanged(const Result& r, std::size_t triangles, std::ptrdiff_t euler_characteristic) {
  EXPECT_EQ(r.triangles, triangles);
  EXPECT_TRUE(r.topology.is_manifold);
  EXPECT_EQ(r.topology.components, 1u);
  EXPECT_EQ(r.topology.euler_characteristic, euler_characteristic);
  EXPECT_EQ(r.repairs.contracted_edges, 0u);
  EXPECT_EQ(r.repairs.dropped_components, 0u);
  EXPECT_GT(r.repairs.moved_vertices, 0u);
  EXPECT_EQ(r.repairs.zero_area_left, 0u);
}

const Triangles antiprism = {{0, 1, 2}, {3, 5, 4}, {0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}, {2, 5, 0}, {0, 5, 3}};

TEST(Zero_area_repair, a_triangle_whose_area_is_too_large_for_a_number_has_one) {
  const std::array<double, 3> a = {0, 0, 0}, b = {1e160, 2e160, 4e160}, c = {3e160, 4e160, 5e160};
  EXPECT_FALSE(internal::has_zero_area(a, b, c));
  EXPECT_TRUE(internal::has_zero_area(a, {1, 2, 4}, {2, 4, 8}));
}

TEST(Zero_area_repair, an_edge_without_length_is_contracted) {
  const auto r = repaired(antiprism, {{0, 0, 0}, {0, 0, 0}, {1, 2, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  EXPECT_EQ(r.triangles, 6u);
  EXPECT_TRUE(r.topology.is_manifold);
  EXPECT_EQ(r.topology.euler_characteristic, 2);
  EXPECT_EQ(r.repairs.contracted_edges, 1u);
  EXPECT_EQ(r.repairs.moved_vertices, 0u);
}

TEST(Zero_area_repair, a_strip_is_not_pinched_between_two_boundaries) {
  // Vertices 0 and 1 lie on different boundaries and have two triangles in common.
  const Triangles strip = {{0, 5, 3}, {0, 3, 1}, {0, 1, 2}, {0, 2, 4}, {2, 1, 6}, {1, 3, 7}};
  expect_unchanged(
      repaired(strip, {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, -1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, 1, 0}, {1, -1, 0}}), 6,
      1);
}

TEST(Zero_area_repair, a_triangle_without_neighbors_stays) {
  expect_unchanged(repaired({{0, 1, 2}}, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}), 1, 1);
}

TEST(Zero_area_repair, a_hole_of_three_edges_stays) {
  const Triangles annulus = {{0, 3, 1}, {1, 3, 4}, {1, 4, 2}, {2, 4, 5}, {2, 5, 0}, {0, 5, 3}};
  expect_unchanged(repaired(annulus, {{0, 0, 0}, {0, 0, 0}, {1, 2, 0}, {-3, -1, 0}, {4, -1, 0}, {1, 5, 0}}), 6, 0);
}

TEST(Zero_area_repair, a_tetrahedron_keeps_its_triangles) {
  expect_unchanged(repaired({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
                   4, 2);
}

TEST(Zero_area_repair, what_is_flat_after_a_move_is_moved_again) {
  const Triangles tetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  expect_unchanged(repaired(tetrahedron, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 2), 4, 2);
  const auto r = repaired(tetrahedron, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 100);
  EXPECT_EQ(r.repairs.zero_area_left, 2u);
}

TEST(Zero_area_repair, a_closed_component_without_area_is_dropped) {
  const auto r = repaired(antiprism, Points(6, {1, 2, 3}));
  EXPECT_EQ(r.triangles, 0u);
  EXPECT_EQ(r.repairs.dropped_components, 1u);
  EXPECT_EQ(r.repairs.moved_vertices, 0u);
}

TEST(Zero_area_repair, a_component_with_boundary_stays) {
  const auto r = repaired({{0, 1, 2}, {2, 1, 3}}, Points(4, {1, 2, 3}));
  EXPECT_EQ(r.triangles, 1u);
  EXPECT_EQ(r.repairs.dropped_components, 0u);
  EXPECT_EQ(r.repairs.zero_area_left, 0u);
}

TEST(Zero_area_repair, a_part_without_area_that_is_cut_off_is_undecided) {
  const Points points(4, {1, 2, 3});
  const auto at = [&](std::size_t v) { return points[v]; };
  const auto nudge = [](std::size_t, int) {};
  for (const bool is_cut : {false, true}) {
    Triangles triangles = {{0, 1, 2}, {2, 1, 3}};
    const auto is_at_cut = [&](std::size_t) { return is_cut; };
    const std::span all(triangles);
    internal::Zero_area_repair repair(all, {0, 1}, at, nudge, is_at_cut);
    repair.run();
    EXPECT_EQ(repair.is_undecided(), is_cut);
  }
}

// From the second flat triangle on, the search for a component meets triangles that it has seen before.
TEST(Zero_area_repair, a_component_with_area_between_two_flat_triangles_stays) {
  expect_unchanged(repaired(antiprism, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 2, 1}}), 8, 2);
}

/// Triangles in a strip, without the vertices whose numbers have that remainder, which are removed.
Triangles strip_without(std::uint32_t vertices, std::uint32_t modulus, std::uint32_t remainder) {
  Triangles triangles;
  for (std::uint32_t v = 0; v + 2 < vertices; ++v)
    if (v % modulus != remainder && (v + 1) % modulus != remainder && (v + 2) % modulus != remainder)
      triangles.push_back({v, v + 1, v + 2});
  return triangles;
}

TEST(Remove_from_mesh, vertices_are_numbered_by_how_many_are_left_before) {
  constexpr std::uint32_t vertices = 5000;
  for (const std::uint32_t modulus : {7u, 64u, 1000u, vertices}) {
    Triangles triangles = strip_without(vertices, modulus, modulus / 2);
    triangles.push_back({0, vertices - 1, 1}); // its numbers are far from each other
    std::vector<std::uint32_t> removed, left(vertices, 0);
    for (std::uint32_t v = modulus / 2; v < vertices; v += modulus) removed.push_back(v);
    for (std::uint32_t v = 1; v < vertices; ++v) left[v] = left[v - 1] + ((v - 1) % modulus != modulus / 2);
    Triangles expected;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (t % 300 != 1) expected.push_back({left[triangles[t][0]], left[triangles[t][1]], left[triangles[t][2]]});
    std::vector<std::size_t> removed_triangles;
    for (std::size_t t = 1; t < triangles.size(); t += 300) removed_triangles.push_back(t);
    const internal::Counts_below removed_before(removed, vertices);
    internal::remove_from_array(removed_triangles, triangles, [&](auto first, auto end, auto to) {
      return internal::write_renumbered(first, end, removed_before, to);
    });
    EXPECT_EQ(triangles, expected) << modulus;
  }
}

} // namespace zero_area_repair_test
