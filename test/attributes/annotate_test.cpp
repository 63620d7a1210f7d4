// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/contraction.h"
#include "support/formulas.h"
#include <equiaffine/attributes/annotate.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace annotate_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex_index = Mesh::Vertex_index;

auto torus() {
  return test::formula("z^2+(sqrt(x^2+y^2)-0.5)^2-0.04", CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
}

TEST(Annotate, property_maps_hold_the_local_structure_of_their_vertices) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  const auto traits = torus();
  Mesh mesh = to_surface_mesh(test::surface_of(traits, {.resolution = 20}));
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

Kernel::Vector_3 normal(const std::vector<Kernel::Point_3>& points, const std::array<std::uint32_t, 3>& t) {
  return CGAL::normal(points[t[0]], points[t[1]], points[t[2]]);
}

TEST(Annotate, no_face_is_lost_where_a_mesh_is_not_a_manifold) {
  const std::vector<Kernel::Point_3> points = {{0, 0, 0},  {0, 0, 1},  {1, 0, 0},  {0, 1, 0},
                                               {-1, 0, 0}, {0, -1, 0}, {0, -1, 1}, {1, 1, 1}};
  const std::vector<std::vector<std::array<std::uint32_t, 3>>> meshes = {
      {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {0, 1, 5}}, // four triangles at an edge, which all pass it alike
      {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {1, 0, 5}}, // two pass it each way
      {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}},            // three fans at a vertex
      {{0, 1, 2}, {0, 1, 3}},                       // neighbors that are oriented differently
      // Three triangles at the edge 01, the first two of which are in one fan around both of its ends.
      {{0, 1, 2}, {0, 2, 3}, {1, 3, 2}, {1, 0, 3}, {0, 1, 4}}};
  for (const auto& triangles : meshes) {
    Isosurface_3<Kernel> surface;
    surface.points = points;
    surface.triangles = triangles;
    surface.vertex_status.assign(points.size(), Point_status::REGULAR);
    surface.vertex_status[0] = Point_status::UNCONVERGED;
    Mesh mesh = to_surface_mesh(surface);
    ASSERT_TRUE(mesh.is_valid(false));
    ASSERT_EQ(mesh.number_of_faces(), triangles.size());
    EXPECT_GT(mesh.number_of_vertices(), points.size());
    for (std::size_t v = 0; v < points.size(); ++v) EXPECT_EQ(mesh.point(Vertex_index(unsigned(v))), points[v]);
    const auto status = mesh.add_property_map<Vertex_index, Point_status>("v:status").first;
    for (const Vertex_index v : mesh.vertices())
      EXPECT_EQ(status[v] == Point_status::UNCONVERGED, mesh.point(v) == points[0]);
    for (const auto face : mesh.faces()) {
      std::vector<Kernel::Point_3> corners;
      for (const Vertex_index v : mesh.vertices_around_face(mesh.halfedge(face))) corners.push_back(mesh.point(v));
      EXPECT_EQ(normal(corners, {0, 1, 2}), normal(points, triangles[std::size_t(face)]));
    }
  }
}

TEST(Annotate, columns_and_maps_hold_the_same_numbers_for_any_number_of_threads) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  const auto traits = torus();
  const auto surface = test::surface_of(traits, {.resolution = 20});
  Mesh mesh = to_surface_mesh(surface);
  annotate<CGAL::Parallel_if_available_tag>(mesh, traits);
  const auto columns =
      compute_attributes(traits, surface, select_attributes("all,quadric_defect,shape_index,curvedness,affine_area"),
                         surface.vertex_status);
  std::size_t scalars = 0;
  for (const auto& column : columns.columns) {
    const auto [map, is_new] = mesh.add_property_map<Vertex_index, double>("v:" + column.name);
    if (is_new) continue; // a component of a vector
    ++scalars;
    for (std::size_t i = 0; i < surface.points.size(); ++i) ASSERT_EQ(column.values[i], map[Vertex_index(unsigned(i))]);
  }
  EXPECT_EQ(scalars, 21u);
}

TEST(Annotate, functions_of_other_numbers_fill_the_maps_that_are_given) {
  using Long = CGAL::Simple_cartesian<long double>;
  const auto sphere =
      make_analytic_traits<Long>([](const auto& x, const auto& y, const auto& z) { return x * x + y * y + z * z - 4.; },
                                 CGAL::Bbox_3(-3, -3, -3, 3, 3, 3));
  Mesh mesh;
  const auto v = mesh.add_vertex(Kernel::Point_3(2, 0, 0));
  const auto H = mesh.add_property_map<Vertex_index, double>("H").first;
  const auto n = mesh.add_property_map<Vertex_index, Kernel::Vector_3>("n").first;
  const auto status = mesh.add_property_map<Vertex_index, Point_status>("s", Point_status::UNCONVERGED).first;
  annotate(mesh, sphere, parameters::vertex_mean_curvature_map(H).vertex_unit_normal_map(n).vertex_status_map(status));
  EXPECT_NEAR(H[v], 0.5, 1e-15);
  EXPECT_EQ(n[v], Kernel::Vector_3(1, 0, 0));
  EXPECT_EQ(status[v], Point_status::UNCONVERGED);
}

TEST(Annotate, a_mesh_without_faces_has_no_areas_and_corners_of_polygons_share_them) {
  const auto traits = torus();
  Mesh mesh;
  for (const double x : {0.7, 0.8})
    for (const double y : {0., 0.3}) mesh.add_vertex(Kernel::Point_3(x, y, 0.1));
  annotate(mesh, traits);
  EXPECT_FALSE(internal::Named_maps<Mesh>::find<double>(mesh, "v:vertex_area"));
  mesh.add_face(Vertex_index(0), Vertex_index(2), Vertex_index(3), Vertex_index(1));
  annotate(mesh, traits);
  const auto area = internal::Named_maps<Mesh>::find<double>(mesh, "v:vertex_area");
  ASSERT_TRUE(area);
  for (const Vertex_index v : mesh.vertices()) EXPECT_NEAR((*area)[v], 0.03 / 4, 1e-15);
}

} // namespace annotate_test
