// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/random_grid.h"
#include "support/trilinear_topology.h"
#include <equiaffine/marching_cubes/internal/marching_cubes_cases.h>
#include <equiaffine/marching_cubes/marching_cubes_of_array.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <random>
#include <set>

namespace marching_cubes_topology_test {

using namespace equiaffine;
using internal::Marching_cubes_cases;

/// A whole number from the environment, where test/long/topology asks for more grids and other seeds.
std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

std::uint64_t number_of_grids() { return from_environment("EQUIAFFINE_TOPOLOGY_GRIDS", 1000); }
std::uint64_t first_seed() { return 1000000 * from_environment("EQUIAFFINE_TOPOLOGY_SEED", 1); }

template <class FT = double>
Array_isosurface_3<FT> surface_of(const Grid& grid) {
  const std::vector<FT> values(grid.values.begin(), grid.values.end());
  return marching_cubes_of_array(std::span<const FT>(values), grid.size, FT(0));
}

class Marching_cubes_topology_of : public testing::TestWithParam<const char*> {};

TEST_P(Marching_cubes_topology_of, is_that_of_the_trilinear_interpolant) {
  const std::string kind = GetParam();
  const bool is_closed = kind == "closed" || kind == "check";
  std::uint64_t judged = 0;
  for (std::uint64_t seed = first_seed(); seed < first_seed() + number_of_grids(); ++seed) {
    const Grid grid = random_grid(kind, seed);
    const auto surface = surface_of(grid);
    const auto t = mesh_topology(surface.triangles, surface.points.size());
    ASSERT_TRUE(t.is_manifold) << kind << " " << seed;
    if (is_closed) {
      ASSERT_EQ(t.boundary_edges, 0u) << kind << " " << seed;
    }
    const auto expected = topology_of_trilinear_surface(grid, seed % 3);
    if (!expected) continue;
    ++judged;
    ASSERT_EQ(long(t.components), expected->components) << kind << " " << seed;
    ASSERT_EQ(t.euler_characteristic, expected->euler_characteristic) << kind << " " << seed;
  }
  EXPECT_GE(double(judged), 0.99 * double(number_of_grids())) << "grids too close to a critical value";
}

INSTANTIATE_TEST_SUITE_P(Kinds, Marching_cubes_topology_of,
                         testing::Values("closed", "open", "check", "cell", "case13"),
                         [](const auto& kind) { return std::string(kind.param); });

// Nodes, and saddles on faces, have the isovalue. In float few positions are left beside a node.
template <class FT>
class Marching_cubes_topology : public testing::Test {};
using Floating_point_types = testing::Types<float, double>;
TYPED_TEST_SUITE(Marching_cubes_topology, Floating_point_types);

/// The grid with small positive values for zeros. Its surface is the one of the grid before repairs: signs are the
/// same.
Grid without_ties(Grid grid) {
  for (double& x : grid.values)
    if (x == 0) x = 1e-7;
  return grid;
}

/// Vertices on edges of the grid lie where the linear interpolant of the values vanishes, but for 1e-6 of the edge or a
/// few roundings.
template <class FT>
void expect_vertices_near_zeros(const Grid& grid, const Array_isosurface_3<FT>& surface) {
  for (const auto& p : surface.points) {
    std::array<std::size_t, 3> node;
    std::size_t inside = 0, axis = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      node[a] = std::size_t(p[a]);
      if (p[a] != FT(node[a])) ++inside, axis = a;
    }
    if (inside != 1) continue; // a vertex at a node, or within a cell
    auto end = node;
    ++end[axis];
    const double f = grid.values[grid.index(node[0], node[1], node[2])],
                 g = grid.values[grid.index(end[0], end[1], end[2])];
    EXPECT_NE(f >= 0, g >= 0) << "an edge without a zero";
    EXPECT_NEAR(double(p[axis]) - double(node[axis]), f / (f - g),
                1e-6 + 8 * double(std::numeric_limits<FT>::epsilon()) * double(end[axis]));
  }
}

/// Judges the surfaces of many grids, and adds up what was done to them.
template <class FT>
Isosurface_repairs repairs_of(const std::string& kind) {
  Isosurface_repairs sum;
  for (std::uint64_t seed = first_seed(); seed < first_seed() + number_of_grids(); ++seed) {
    const Grid grid = random_grid(kind, seed);
    const auto surface = surface_of<FT>(grid);
    sum.contracted_edges += surface.repairs.contracted_edges;
    sum.dropped_components += surface.repairs.dropped_components;
    sum.moved_vertices += surface.repairs.moved_vertices;
    EXPECT_EQ(surface.repairs.zero_area_left, 0u) << kind << " " << seed;
    for (const auto& [a, b, c] : surface.triangles) {
      const auto& p = surface.points;
      EXPECT_FALSE(internal::has_zero_area(p[a], p[b], p[c])) << kind << " " << seed;
    }
    expect_vertices_near_zeros(grid, surface);
    const auto before = surface_of(without_ties(grid));
    const auto t = mesh_topology(surface.triangles, surface.points.size()),
               u = mesh_topology(before.triangles, before.points.size());
    EXPECT_TRUE(t.is_manifold) << kind << " " << seed;
    EXPECT_TRUE(kind == "holes" || t.boundary_edges == 0) << kind << " " << seed;
    // A component without area is a sphere.
    EXPECT_EQ(t.components + surface.repairs.dropped_components, u.components) << kind << " " << seed;
    EXPECT_EQ(t.euler_characteristic + 2 * long(surface.repairs.dropped_components), u.euler_characteristic)
        << kind << " " << seed;
    if (testing::Test::HasFailure()) break;
  }
  return sum;
}

TYPED_TEST(Marching_cubes_topology, surfaces_through_nodes_are_repaired_and_keep_their_topology) {
  const auto sum = repairs_of<TypeParam>("ties");
  EXPECT_GT(sum.contracted_edges, 10 * number_of_grids());
  EXPECT_GT(sum.dropped_components, 0u);
  EXPECT_GT(sum.moved_vertices, 0u);
}

TYPED_TEST(Marching_cubes_topology, surfaces_through_nodes_beside_nodes_without_a_value_keep_their_topology_too) {
  const auto sum = repairs_of<TypeParam>("holes");
  EXPECT_GT(sum.contracted_edges, number_of_grids());
  EXPECT_GT(sum.moved_vertices, 0u);
}

/// Two cells side by side of Chernyaev's case 7.4.2, of which an implementation of Lewiner's tables gave a triangle
/// twice.
TEST(Marching_cubes_topology, no_triangle_occurs_twice_between_two_ambiguous_cells) {
  const std::vector<double> values = {13, -1, -1, -7, -1, 1, 7, -7, 15, -9, -3, -1};
  const auto surface = marching_cubes_of_array(std::span<const double>(values), {2, 2, 3}, 0.0);
  std::set<std::set<std::uint32_t>> triangles;
  for (const auto& t : surface.triangles) EXPECT_TRUE(triangles.emplace(t.begin(), t.end()).second);
  EXPECT_GT(triangles.size(), 0U);
  EXPECT_TRUE(mesh_topology(surface.triangles, surface.points.size()).is_manifold);
}

TYPED_TEST(Marching_cubes_topology, volumes_of_small_integers_have_no_holes_at_any_of_their_values) {
  constexpr std::size_t n = 9;
  std::mt19937 random(5);
  for (int grid = 0; grid < 100; ++grid) {
    std::vector<TypeParam> values(n * n * n, TypeParam(-4));
    for (std::size_t k = 1; k + 1 < n; ++k)
      for (std::size_t j = 1; j + 1 < n; ++j)
        for (std::size_t i = 1; i + 1 < n; ++i) values[i + n * (j + n * k)] = TypeParam(int(random() % 7) - 3);
    for (int level = -3; level <= 3; ++level) {
      const auto surface = marching_cubes_of_array(std::span<const TypeParam>(values), {n, n, n}, TypeParam(level));
      const auto t = mesh_topology(surface.triangles, surface.points.size());
      EXPECT_TRUE(t.is_manifold) << grid << " " << level;
      EXPECT_EQ(t.boundary_edges, 0U) << grid << " " << level;
    }
  }
}

TEST(Trilinear_topology, the_oracle_says_the_same_along_all_axes) {
  for (const char* kind : {"closed", "check", "cell", "case13"})
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      const Grid grid = random_grid(kind, seed);
      const auto a = topology_of_trilinear_surface(grid, 0);
      for (std::size_t axis : {1U, 2U}) {
        const auto b = topology_of_trilinear_surface(grid, axis);
        if (!a || !b) continue;
        ASSERT_EQ(a->components, b->components) << kind << " " << seed;
        ASSERT_EQ(a->euler_characteristic, b->euler_characteristic) << kind << " " << seed;
      }
    }
}

// Tests of the tables follow.

/// Every directed edge of the triangles of a sub-case, with how often it occurs.
std::map<std::pair<int, int>, int> directed_edges(const Marching_cubes_cases::Sub_case& sub_case) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : sub_case.triangles)
    for (std::size_t m = 0; m < 3; ++m) ++edges[{t[m], t[(m + 1) % 3]}];
  return edges;
}

/// The directed edges that no triangle has the other way round: there the mesh goes on in the next cell.
std::set<std::pair<int, int>> border(const Marching_cubes_cases::Sub_case& sub_case) {
  const auto edges = directed_edges(sub_case);
  std::set<std::pair<int, int>> result;
  for (const auto& [edge, n] : edges)
    if (!edges.contains({edge.second, edge.first})) result.insert(edge);
  return result;
}

bool lies_in_face(int edge, int face) {
  const auto c = internal::face_corners(face);
  const auto has = [&](int corner) { return std::find(c.begin(), c.end(), corner) != c.end(); };
  return edge < 12 && has(internal::first_corner(edge)) && has(internal::second_corner(edge));
}

TEST(Marching_cubes_cases, every_sub_case_is_a_manifold_with_the_right_topology) {
  const auto& cases = Marching_cubes_cases::instance();
  EXPECT_GT(cases.size(), 800u);
  for (std::size_t s = 0; s < cases.size(); ++s) {
    const auto& sub_case = cases[s];
    std::map<int, std::uint32_t> names;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (const auto& t : sub_case.triangles) {
      triangles.emplace_back();
      for (std::size_t m = 0; m < 3; ++m) triangles.back()[m] = names.try_emplace(t[m], names.size()).first->second;
    }
    const auto t = mesh_topology(triangles, names.size());
    EXPECT_TRUE(t.is_manifold || triangles.empty()) << s;
    EXPECT_EQ(t.euler_characteristic, sub_case.boundary_curves - 2 * sub_case.tunnels) << s;
    EXPECT_EQ(long(t.components), sub_case.boundary_curves - sub_case.tunnels) << s;
    for (const auto& [edge, n] : directed_edges(sub_case)) EXPECT_EQ(n, 1) << s;
  }
}

/// All sub-cases of a sign pattern with the decision on a face.
template <class Visit>
void for_each_sub_case(const Visit& visit) {
  const auto& cases = Marching_cubes_cases::instance();
  for (unsigned signs = 0; signs < 256; ++signs) {
    const unsigned faces = cases.ambiguous_faces(signs);
    for (unsigned joined = 0; joined <= faces; ++joined) {
      if ((joined & ~faces) != 0) continue;
      const auto& variant = cases.variant(signs, joined);
      for (std::size_t n = 0; n <= variant.tunnels.size(); ++n) visit(signs, joined, cases[variant.sub_case + n]);
    }
  }
}

// What a sub-case leaves on a face depends on nothing but the signs there and the decision on the face, it is the same
// seen from both sides, and nothing else lies in a face: so any two sub-cases that can meet at a face fit together.
TEST(Marching_cubes_cases, every_pair_of_sub_cases_fits_together_across_a_face) {
  for (int axis = 0; axis < 3; ++axis) {
    // From the signs and the decision on the face to its segments, as edges of the lower cell.
    std::map<std::pair<unsigned, bool>, std::set<std::pair<int, int>>> seen_from_below, seen_from_above;
    const auto to_lower = [&](int edge) {
      return internal::edge_between(internal::first_corner(edge) | 1 << axis,
                                    internal::second_corner(edge) | 1 << axis);
    };
    for_each_sub_case([&](unsigned signs, unsigned joined, const auto& sub_case) {
      for (int side = 0; side < 2; ++side) {
        const int face = 2 * axis + side;
        unsigned face_signs = 0;
        for (unsigned c = 0, n = 0; c < 8; ++c)
          if (int(c >> axis & 1) == side) face_signs |= (signs >> c & 1) << n++;
        std::set<std::pair<int, int>> segments;
        const auto rim = border(sub_case);
        for (const auto& [edge, n] : directed_edges(sub_case)) {
          if (!lies_in_face(edge.first, face) || !lies_in_face(edge.second, face)) continue;
          EXPECT_TRUE(rim.contains(edge)) << "a chord in a face";
          if (side == 1) segments.insert(edge);
          else segments.insert({to_lower(edge.second), to_lower(edge.first)});
        }
        auto& seen = side == 1 ? seen_from_below : seen_from_above;
        const auto [known, is_new] = seen.try_emplace({face_signs, (joined >> face & 1) != 0}, segments);
        EXPECT_EQ(known->second, segments);
      }
    });
    EXPECT_EQ(seen_from_below, seen_from_above);
    EXPECT_EQ(seen_from_below.size(), 18u) << "16 patterns, two of them with a choice";
  }
}

TEST(Marching_cubes_cases, the_border_of_a_sub_case_lies_in_the_faces) {
  for_each_sub_case([](unsigned signs, unsigned, const auto& sub_case) {
    for (const auto& [a, b] : border(sub_case)) {
      int faces = 0;
      for (int face = 0; face < 6; ++face) faces += lies_in_face(a, face) && lies_in_face(b, face);
      EXPECT_EQ(faces, 1) << signs;
    }
  });
}

// Tests of exactness follow.

/// A cell whose face z = 0 has the saddle p q - r s for diagonal positive p, q and negative r, s.
bool is_joined_on_bottom(double p, double q, double r, double s, double isovalue = 0) {
  const std::array<double, 8> v = {p, -r, -s, q, 1, 1, 1, 1};
  const auto& cases = Marching_cubes_cases::instance();
  const unsigned signs = 0b11111001;
  const std::size_t sub_case = internal::Trilinear_cell<double>(v, isovalue).sub_case(signs);
  const std::size_t joined = cases.variant(signs, 1U << 4).sub_case, separate = cases.variant(signs, 0).sub_case;
  EXPECT_TRUE(sub_case == joined || sub_case == separate);
  return sub_case == joined;
}

TEST(Trilinear_cell, saddles_on_faces_are_decided_exactly) {
  const double u = std::numeric_limits<double>::epsilon();
  EXPECT_TRUE(is_joined_on_bottom(1, 1, 1, 1)) << "a saddle of value zero is positive";
  EXPECT_FALSE(is_joined_on_bottom(3, 1.0 / 3, 1, 1)) << "3 (1 / 3) is less than 1 but rounds to 1";
  // (1 + u)(1 - u) = 1 - u^2 < 1 rounds to 1.
  EXPECT_FALSE(is_joined_on_bottom(1 + u, 1 - u, 1, 1));
  EXPECT_TRUE(is_joined_on_bottom(1, 1, 1 + u, 1 - u));
  for (double scale : {1e-160, 1e-300, 1e160, 1e300}) {
    EXPECT_FALSE(is_joined_on_bottom((1 + u) * scale, (1 - u) * scale, scale, scale)) << scale;
    EXPECT_TRUE(is_joined_on_bottom(scale, scale, (1 + u) * scale, (1 - u) * scale)) << scale;
  }
  // Differences from the isovalue that round, so that the products are in the wrong order.
  EXPECT_FALSE(is_joined_on_bottom(1 + 2 * u, 1 + u, 1 + u, 1 + u, 0.45 * u));
  EXPECT_TRUE(is_joined_on_bottom(1 + u, 1 + u, 1 + 2 * u, 1 + u, -0.45 * u));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(is_joined_on_bottom(infinity, 1, 1, 1));
  EXPECT_FALSE(is_joined_on_bottom(1, 1, infinity, 1));
}

TEST(Trilinear_cell, the_isovalue_is_subtracted_exactly) {
  // 1e16 + 1 is not a double: with a rounded difference the saddle would vanish.
  const std::array<float, 8> v = {1e16F, -1e16F, -1e16F, 1e16F, 1e16F, 1e16F, 1e16F, 1e16F};
  const auto& cases = Marching_cubes_cases::instance();
  const unsigned signs = 0b11111001;
  EXPECT_EQ((internal::Trilinear_cell<float>(v, 1.0F).sub_case(signs)), cases.variant(signs, 0).sub_case);
  EXPECT_EQ((internal::Trilinear_cell<float>(v, -1.0F).sub_case(signs)), cases.variant(signs, 1U << 4).sub_case);
}

TEST(Trilinear_cell, saddles_inside_are_decided_exactly) {
  const auto& cases = Marching_cubes_cases::instance();
  const unsigned signs = 0b10000001;
  ASSERT_TRUE(cases.is_ambiguous(signs));
  const auto tunnels = [&](double h) {
    const std::array<double, 8> v = {h, -1, -1, -1, -1, -1, -1, h};
    return cases[internal::Trilinear_cell<double>(v, 0.0).sub_case(signs)].tunnels;
  };
  // The saddle lies in the middle by symmetry, where f = (2 h - 6) / 8.
  const double u = std::numeric_limits<double>::epsilon();
  EXPECT_EQ(tunnels(3 * (1 - u)), 0);
  EXPECT_EQ(tunnels(3), 1) << "a saddle of value zero is positive";
  EXPECT_EQ(tunnels(3 * (1 + u)), 1);
}

} // namespace marching_cubes_topology_test
