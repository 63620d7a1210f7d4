// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/Expression_3.h>
#include <equiaffine/annotate.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
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
  const auto traits = torus();
  const auto surface = marching_cubes(traits, parameters::number_of_nodes(20));
  Mesh mesh = to_surface_mesh(surface);
  annotate<CGAL::Parallel_tag>(mesh, traits);
  const auto columns = compute_attributes(traits, std::span(surface.points), select_attributes("all,quadric_defect"),
                                          surface.vertex_status);
  std::size_t scalars = 0;
  for (const auto& column : columns.columns) {
    const auto [map, is_new] = mesh.add_property_map<Vertex_index, double>("v:" + column.name);
    if (is_new) continue; // a component of a vector
    ++scalars;
    for (std::size_t i = 0; i < surface.points.size(); ++i) ASSERT_EQ(column.values[i], map[Vertex_index(unsigned(i))]);
  }
  EXPECT_EQ(scalars, 16u);
}

TEST(Annotate, unconverged_vertices_stay_unconverged) {
  const auto traits = torus();
  const std::vector<Kernel::Point_3> points = {{0.7, 0.1, 0.1}, {0, 0, 0.5}};
  const std::vector<Point_status> sampled = {Point_status::UNCONVERGED, Point_status::UNCONVERGED};
  const auto columns = compute_attributes(traits, std::span(points), select_attributes("k1"), sampled);
  ASSERT_TRUE(columns.status);
  EXPECT_EQ(columns.status->at(0), Point_status::UNCONVERGED);
  EXPECT_TRUE(std::isfinite(columns.columns[0].values[0]));
  EXPECT_EQ(columns.status->at(1), Point_status::UNCONVERGED);
  EXPECT_TRUE(std::isnan(columns.columns[0].values[1])) << "on the axis the square root has no derivatives";
}

TEST(Attributes, the_names_are_the_contract_in_its_order) {
  const auto names = [](const char* list) {
    std::string joined;
    for (const Attribute& a : select_attributes(list).columns) joined += std::string(a.name) + " ";
    return joined;
  };
  const std::string basic = "nx ny nz k1 k2 gaussian_curvature mean_curvature conormal_x conormal_y conormal_z "
                            "affine_normal_x affine_normal_y affine_normal_z affine_gaussian_curvature "
                            "affine_mean_curvature pick_invariant ";
  EXPECT_EQ(names("basic"), basic);
  EXPECT_EQ(names("all"), basic +
                              "affine_k1 affine_k2 direction1_x direction1_y direction1_z direction2_x direction2_y "
                              "direction2_z metric_xx metric_xy metric_xz metric_yy metric_yz metric_zz ");
  EXPECT_EQ(names("none"), "");
  EXPECT_EQ(names("metric_xx,normal,k2"), "nx ny nz k2 metric_xx ");
  EXPECT_EQ(names("status"), "");
  EXPECT_FALSE(select_attributes("none").has_status);
  EXPECT_TRUE(select_attributes("status").has_status);
  EXPECT_THROW(select_attributes("k3"), Input_error);
  EXPECT_THROW(select_attributes("k1,"), Input_error);
  EXPECT_THROW(select_attributes(""), Input_error);
}

} // namespace
