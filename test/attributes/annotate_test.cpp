// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/contraction.h"
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/Expression_3.h>
#include <equiaffine/annotate.h>
#include <equiaffine/marching_cubes.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string>

namespace {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex_index = Mesh::Vertex_index;

auto torus() {
  return make_analytic_traits<Kernel>(Expression_3("z^2+(sqrt(x^2+y^2)-0.5)^2-0.04"),
                                      CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
}

TEST(Annotate, property_maps_hold_the_local_structure_of_their_vertices) {
  const auto traits = torus();
  Mesh mesh = to_surface_mesh(marching_cubes(traits, parameters::number_of_nodes(20)));
  annotate(mesh, traits);
  ASSERT_TRUE(mesh.is_valid(false));
  const auto scalar = [&](const std::string& name) {
    const auto [map, is_new] = mesh.add_property_map<Vertex_index, double>("v:" + name);
    EXPECT_FALSE(is_new) << name;
    return map;
  };
  const auto vector = [&](const std::string& name) {
    const auto [map, is_new] = mesh.add_property_map<Vertex_index, Kernel::Vector_3>("v:" + name);
    EXPECT_FALSE(is_new) << name;
    return map;
  };
  const auto status = mesh.add_property_map<Vertex_index, Point_status>("v:status").first;
  for (const Vertex_index v : mesh.vertices()) {
    const auto s = local_structure_at(traits, mesh.point(v));
    ASSERT_EQ(status[v], s.status);
    ASSERT_EQ(scalar("gaussian_curvature")[v], s.euclidean.gaussian_curvature);
    ASSERT_EQ(scalar("affine_gaussian_curvature")[v], s.affine.gaussian_curvature);
    ASSERT_EQ(scalar("pick_invariant")[v], s.affine.pick_invariant);
    ASSERT_EQ(scalar("metric_yz")[v], s.affine.metric[4]);
    ASSERT_EQ(vector("normal")[v].y(), s.euclidean.normal[1]);
    ASSERT_EQ(vector("conormal")[v].z(), s.affine.conormal[2]);
    ASSERT_EQ(vector("affine_normal")[v].x(), s.affine.normal[0]);
  }
}

TEST(Annotate, columns_and_maps_hold_the_same_numbers_for_any_number_of_threads) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  const auto traits = torus();
  const auto surface = marching_cubes(traits, parameters::number_of_nodes(20));
  Mesh mesh = to_surface_mesh(surface);
  annotate<CGAL::Parallel_tag>(mesh, traits);
  const auto columns =
      compute_attributes(traits, std::span(surface.points),
                         select_attributes("all,quadric_defect,shape_index,curvedness"), surface.vertex_status);
  std::size_t scalars = 0;
  for (const auto& column : columns.columns) {
    const auto [map, is_new] = mesh.add_property_map<Vertex_index, double>("v:" + column.name);
    if (is_new) continue; // a component of a vector
    ++scalars;
    for (std::size_t i = 0; i < surface.points.size(); ++i) ASSERT_EQ(column.values[i], map[Vertex_index(unsigned(i))]);
  }
  EXPECT_EQ(scalars, 18u);
}

} // namespace
