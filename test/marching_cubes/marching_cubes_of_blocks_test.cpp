// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Without_bounds.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/marching_cubes/marching_cubes_in_slabs.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace marching_cubes_of_blocks_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Size = std::array<std::size_t, 3>;

/// A mesh whose vertices are known by their ids.
struct Mesh_of_ids {
  std::map<Vertex_id, std::pair<Kernel::Point_3, Point_status>> vertices;
  std::map<Vertex_id, Vertex_id> least_ids;
  std::size_t owners = 0; // of vertices
  std::vector<std::array<Vertex_id, 3>> triangles;

  bool operator==(const Mesh_of_ids&) const = default;
};

/// Adds the mesh of a block to that of others, with which it must agree where both have a vertex.
template <class Traits>
void add_block(Mesh_of_ids& mesh, const Traits& traits, const Size& nodes, const Cell_block& block,
               const Slab_options& options, const std::string& name) {
  std::vector<Vertex_id> ids;
  marching_cubes_of_block(
      traits, block,
      [&](const Isosurface_slab_3<Kernel>& slab) {
        EXPECT_EQ(slab.first_vertex, ids.size());
        ids.insert(ids.end(), slab.vertex_ids.begin(), slab.vertex_ids.end());
        for (std::size_t v = 0; v < slab.points.size(); ++v) {
          const auto vertex = std::pair(slab.points[v], slab.vertex_status[v]);
          const auto [place, is_new] = mesh.vertices.try_emplace(slab.vertex_ids[v], vertex);
          EXPECT_TRUE(is_new || place->second == vertex) << name;
          const Vertex_id least = slab.least_ids[v];
          EXPECT_EQ(mesh.least_ids.try_emplace(slab.vertex_ids[v], least).first->second, least) << name;
          mesh.owners += block.contains(cell_of(least, nodes));
        }
        for (const auto& [a, b, c] : slab.triangles) mesh.triangles.push_back({ids[a], ids[b], ids[c]});
      },
      options);
  EXPECT_EQ(std::set(ids.begin(), ids.end()).size(), ids.size()) << name << ": a vertex is twice in a block";
}

/// The mesh of blocks, into which the lattice is cut at the given cells along each axis.
template <class Traits>
Mesh_of_ids mesh_of_blocks(const Traits& traits, const Size& nodes, const std::array<std::vector<std::size_t>, 3>& cuts,
                           const Slab_options& options, const std::string& name) {
  Mesh_of_ids mesh;
  std::array<std::vector<std::size_t>, 3> ends = cuts;
  for (std::size_t a = 0; a < 3; ++a) {
    ends[a].insert(ends[a].begin(), 0);
    ends[a].push_back(nodes[a] - 1);
  }
  for (std::size_t z = 0; z + 1 < ends[2].size(); ++z)
    for (std::size_t y = 0; y + 1 < ends[1].size(); ++y)
      for (std::size_t x = 0; x + 1 < ends[0].size(); ++x)
        add_block(mesh, traits, nodes,
                  {{ends[0][x], ends[1][y], ends[2][z]}, {ends[0][x + 1], ends[1][y + 1], ends[2][z + 1]}}, options,
                  name);
  EXPECT_EQ(mesh.owners, mesh.vertices.size()) << name << ": a vertex belongs to no block that has it, or to two";
  std::sort(mesh.triangles.begin(), mesh.triangles.end());
  return mesh;
}

/// Expects that the mesh of one block has the vertices and triangles of marching_cubes() in another order, and that
/// blocks together have the same mesh as one.
template <class Traits>
void expect_same(const Traits& traits, const Size& nodes, const Marching_cubes_options& options,
                 const std::string& name) {
  const auto whole = marching_cubes(traits, options);
  const Mesh_of_ids mesh = mesh_of_blocks(traits, nodes, {}, {.sampling = options}, name);
  ASSERT_EQ(mesh.vertices.size(), whole.points.size()) << name;
  std::vector<std::array<Kernel::Point_3, 3>> expected, triangles;
  for (const auto& [a, b, c] : whole.triangles) expected.push_back({whole.points[a], whole.points[b], whole.points[c]});
  for (const auto& [a, b, c] : mesh.triangles)
    triangles.push_back({mesh.vertices.at(a).first, mesh.vertices.at(b).first, mesh.vertices.at(c).first});
  std::sort(expected.begin(), expected.end());
  std::sort(triangles.begin(), triangles.end());
  EXPECT_EQ(triangles, expected) << name;
  const auto [x, y, z] = nodes;
  const std::vector<std::array<std::vector<std::size_t>, 3>> ways = {{{{}, {}, {z / 2}}},
                                                                     {{{x / 2}, {}, {}}},
                                                                     {{{1, x / 2}, {y / 3, y - 2}, {}}},
                                                                     {{{x / 2}, {y / 2}, {z / 3, z / 2}}}};
  for (std::size_t n = 0; n < ways.size(); ++n) {
    const std::string way = name + ", way " + std::to_string(n);
    const Mesh_of_ids blocks = mesh_of_blocks(traits, nodes, ways[n], {.sampling = options, .planes_per_slab = 5}, way);
    EXPECT_TRUE(blocks == mesh) << way;
  }
}

TEST(Marching_cubes_of_blocks, blocks_are_the_mesh_whatever_the_function_is) {
  const std::array<const char*, 13> functions = {"x^2+y^2+z^2-1",
                                                 "x^2+y^2+z^2-0.36",
                                                 "x^2-y^2",
                                                 "y^2-z^2",
                                                 "x*y*z",
                                                 "x",
                                                 "-(x^2+y^2)",
                                                 "-(x^2+y^2+max(0,z^2-0.25))",
                                                 "-abs(z)",
                                                 "sqrt(0.5-x^2-y^2)-z",
                                                 "z/x",
                                                 "tan(x)-y",
                                                 "sin(7*x)*cos(7*y)+sin(7*y)*cos(7*z)+sin(7*z)*cos(7*x)"};
  const Size nodes = {21, 20, 31};
  for (const char* text : functions) {
    const auto traits = make_analytic_traits<Kernel>(Expression_3(text), CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
    expect_same(traits, nodes, {.resolution = nodes}, text);
    expect_same(Without_bounds(traits), nodes, {.resolution = nodes}, text);
  }
}

TEST(Marching_cubes_of_blocks, blocks_are_the_mesh_of_random_samples) {
  std::mt19937 random(17);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Size nodes = {12, 10, 13};
  for (int n = 0; n < 2; ++n)
    for (const auto& values : {std::vector{-0.7, -0.1, 0.2, 0.9}, std::vector{-1.0, -0.5, 0.0, 0.5, 1.0},
                               std::vector{-1.0, 0.0, 0.0, 1.0, nan}}) {
      Volume_3<Kernel> volume{Lattice_3<Kernel>(nodes, CGAL::Bbox_3(0, 0, 0, 11, 9, 12)), {}};
      for (std::size_t i = 0; i < volume.lattice.number_of_nodes(); ++i)
        volume.values.push_back(values[random() % values.size()]);
      const Sampled_function_traits_3<Kernel> traits(volume);
      for (const auto position : {Vertex_position::LINEAR, Vertex_position::PROJECTED})
        expect_same(traits, nodes, {.vertices = position}, "volume " + std::to_string(n));
    }
}

TEST(Marching_cubes_of_blocks, cells_must_be_known) {
  const auto traits = make_analytic_traits<Kernel>(Expression_3("x^2+y^2+z^2-1"), CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  const auto run = [&](const Cell_block& block, const Cell_block& known) {
    marching_cubes_of_block(
        traits, block, [](const auto&) {}, {.sampling = {.resolution = 21}}, known);
  };
  const Cell_block all{{0, 0, 0}, {20, 20, 20}}, half{{0, 0, 0}, {20, 20, 10}};
  EXPECT_NO_THROW(run(half, {{0, 0, 0}, {20, 20, 14}}));
  EXPECT_THROW(run(half, {{0, 0, 0}, {20, 20, 13}}), std::invalid_argument);
  EXPECT_THROW(run({{0, 0, 0}, {20, 20, 21}}, all), std::invalid_argument);
  EXPECT_THROW(run({{0, 5, 0}, {20, 5, 20}}, all), std::invalid_argument);
}

} // namespace marching_cubes_of_blocks_test
