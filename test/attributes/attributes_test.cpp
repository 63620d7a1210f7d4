// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/contraction.h"
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/base/Input_error.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/marching_cubes/marching_cubes.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

namespace attributes_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

auto traits_of(const char* formula) {
  return make_analytic_traits<Kernel>(Expression_3(formula), CGAL::Bbox_3(-2, -2, -1, 2, 2, 1));
}

// On the axis the square root has no derivatives.
auto implicit_torus() { return traits_of("z^2+(sqrt(x^2+y^2)-0.5)^2-0.04"); }

// More than a block of packs, with some on the axis.
std::vector<Point_3> points() {
  std::vector<Point_3> result;
  for (int n = 0; n < 203; ++n)
    result.emplace_back(n % 7 == 0 ? 0 : 1.3 * std::cos(n), n % 7 == 0 ? 0 : 1.3 * std::sin(n), 0.001 * n);
  return result;
}

TEST(Attributes, columns_are_the_same_with_and_without_the_status) {
  const auto p = points();
  Attribute_selection selection = select_attributes("normal,k1,affine_mean_curvature,pick_invariant_gradient");
  const auto with = compute_attributes(implicit_torus(), std::span(p).first(40), selection);
  selection.has_status = false;
  const auto without = compute_attributes(implicit_torus(), std::span(p).first(40), selection);
  ASSERT_TRUE(with.status);
  EXPECT_FALSE(without.status);
  ASSERT_EQ(without.columns.size(), 6u);
  for (std::size_t c = 0; c < 6; ++c)
    for (std::size_t i = 0; i < 40; ++i)
      if (const double expected = with.columns[c].values[i]; std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(without.columns[c].values[i]));
      } else {
        EXPECT_EQ(without.columns[c].values[i], expected) << without.columns[c].name << ' ' << i;
      }
  EXPECT_NE(without.columns[3].values[1], 0);
}

TEST(Attributes, unconverged_points_stay_unconverged_unless_they_are_outside) {
  const std::vector<Point_3> p = {{0.7, 0.1, 0.1}, {0, 0, 0.5}};
  const std::vector<Point_status> sampled = {Point_status::UNCONVERGED, Point_status::UNCONVERGED};
  const auto on_torus = compute_attributes(implicit_torus(), std::span(p), select_attributes("k1"), sampled);
  ASSERT_TRUE(on_torus.status);
  EXPECT_EQ(*on_torus.status, sampled);
  EXPECT_TRUE(std::isfinite(on_torus.columns[0].values[0]));
  EXPECT_TRUE(std::isnan(on_torus.columns[0].values[1]));
  const auto logarithm = traits_of("log(x)+y+z^2");
  const auto beside = compute_attributes(logarithm, std::span(p), select_attributes("k1"), sampled);
  EXPECT_EQ(*beside.status, (std::vector{Point_status::UNCONVERGED, Point_status::OUTSIDE}));
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_EQ(local_structure_at(logarithm, p[i], sampled[i]).status, beside.status->at(i));
}

TEST(Attributes, numbers_made_of_principal_curvatures_have_the_same_bits_in_packs_and_exist_at_parabolic_points) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  const auto traits = traits_of("z-x^2-y^3"); // parabolic where y = 0, as on the axis
  const auto p = points();
  const auto selection = select_attributes("shape_index,curvedness");
  const auto batch = compute_attributes(traits, p, selection);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto single = local_structure_at(traits, p[i]);
    EXPECT_EQ(single.status, p[i].y() == 0 ? Point_status::PARABOLIC : Point_status::REGULAR) << i;
    for (std::size_t c = 0; c < selection.columns.size(); ++c) {
      EXPECT_EQ(batch.columns[c].values[i], selection.columns[c].get(single)) << i;
      EXPECT_TRUE(std::isfinite(batch.columns[c].values[i])) << i;
    }
  }
}

TEST(Attributes, planar_points_have_no_shape_index) {
  const std::vector<Point_3> origin = {{0, 0, 0}};
  const auto attributes = compute_attributes(traits_of("z-x^3-y^3"), origin, select_attributes("k1,shape_index"));
  EXPECT_EQ(attributes.status->at(0), Point_status::PARABOLIC);
  EXPECT_EQ(attributes.columns[0].values[0], 0);
  EXPECT_TRUE(std::isnan(attributes.columns[1].values[0]));
}

TEST(Attributes, the_status_comes_without_columns_and_nothing_where_nothing_was_asked_for) {
  const auto p = points();
  const auto status = compute_attributes(implicit_torus(), p, select_attributes("status"));
  ASSERT_TRUE(status.status);
  EXPECT_TRUE(status.columns.empty());
  EXPECT_EQ(status.status->at(1), Point_status::REGULAR);
  const auto nothing = compute_attributes(implicit_torus(), p, select_attributes("none"));
  EXPECT_TRUE(nothing.columns.empty() && !nothing.status);
}

TEST(Attributes, areas_around_vertices_add_up_to_those_of_the_mesh) {
  constexpr double radius = 1.5, density = 0.8164965809277260; // (1 / radius^2)^(1/4)
  const auto sphere = make_analytic_traits<Kernel>(Expression_3("x^2+y^2+z^2-2.25"), CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  const auto mesh = marching_cubes(sphere, {.resolution = 24});
  const auto selection = select_attributes("vertex_area,affine_area");
  const auto attributes = compute_attributes(sphere, mesh, selection);
  double area = 0, sum = 0, affine = 0;
  for (const auto& t : mesh.triangles)
    area += std::sqrt(CGAL::squared_area(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]));
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const double of_vertex = attributes.columns[0].values[i];
    EXPECT_GT(of_vertex, 0);
    EXPECT_NEAR(attributes.columns[1].values[i], density * of_vertex, 1e-12 * of_vertex);
    sum += of_vertex;
    affine += attributes.columns[1].values[i];
  }
  EXPECT_NEAR(sum, area, 1e-12 * area);
  EXPECT_NEAR(affine, density * area, 1e-12 * area);
  EXPECT_NEAR(area, 4 * std::numbers::pi * radius * radius, 0.02 * area);
}

TEST(Attributes, areas_are_unknown_without_a_mesh) {
  const auto p = points();
  const auto selection = select_attributes("vertex_area,k1,affine_area");
  const auto attributes = compute_attributes(implicit_torus(), p, selection);
  EXPECT_TRUE(std::isnan(attributes.columns[0].values[1]) && std::isnan(attributes.columns[2].values[1]));
  EXPECT_TRUE(std::isfinite(attributes.columns[1].values[1]));
  const Indexed_triangle_mesh_3<Kernel> without_triangles{p, {}};
  EXPECT_THROW(compute_attributes(implicit_torus(), without_triangles, selection), Input_error);
  const std::vector<double> too_few(3);
  EXPECT_THROW(compute_attributes(implicit_torus(), p, selection, {std::span<const Point_status>(), too_few}),
               std::invalid_argument);
}

} // namespace attributes_test
