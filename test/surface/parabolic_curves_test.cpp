// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/formulas.h"
#include <equiaffine/function/expand.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/io/write_curves.h>
#include <equiaffine/mesh/to_face_graph.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Named_function_parameters.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <sstream>

namespace parabolic_curves_test {

using namespace equiaffine;
using namespace equiaffine::test;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

auto torus() { return formula("(sqrt(x^2+y^2)-.5)^2+z^2-.04", CGAL::Bbox_3(-.8, -.8, -.3, .8, .8, .3)); }

TEST(Parabolic_curves, those_of_a_torus_are_its_two_highest_circles) {
  const auto traits = torus();
  const auto curves = parabolic_curves(surface_of(traits, {.resolution = 40}), traits);
  ASSERT_EQ(curves.polylines.size(), 2u);
  EXPECT_EQ(curves.unconverged_points, 0u);
  for (const auto& line : curves.polylines) {
    EXPECT_TRUE(line.is_closed);
    double length = 0;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const Point_3& p = line.points[i];
      EXPECT_NEAR(std::hypot(p.x(), p.y()), 0.5, 1e-13);
      EXPECT_NEAR(std::abs(p.z()), 0.2, 1e-14);
      length += std::sqrt(CGAL::squared_distance(p, line.points[(i + 1) % line.points.size()]));
    }
    EXPECT_NEAR(length, CGAL_PI, 0.01) << "neighbors in the list are neighbors on the circle";
  }
}

TEST(Parabolic_curves, those_of_a_graph_are_those_of_its_triangles) {
  const auto traits = torus();
  const auto surface = surface_of(traits, {.resolution = 40});
  const auto expected = parabolic_curves(surface, traits);
  CGAL::Polyhedron_3<CGAL::Exact_predicates_inexact_constructions_kernel> polyhedron;
  to_face_graph(surface, polyhedron);
  auto mesh = to_surface_mesh(surface);
  mesh.remove_vertex(mesh.add_vertex(Point_3(0, 0, 0)));
  for (const auto& curves : {parabolic_curves(mesh, traits), parabolic_curves(polyhedron, traits),
                             parabolic_curves<CGAL::Parallel_if_available_tag>(
                                 mesh, traits, CGAL::parameters::vertex_point_map(mesh.points()))}) {
    ASSERT_EQ(curves.polylines.size(), expected.polylines.size());
    for (std::size_t n = 0; n < curves.polylines.size(); ++n)
      EXPECT_EQ(curves.polylines[n].points, expected.polylines[n].points);
  }
}

TEST(Parabolic_curves, points_are_exact_where_a_curve_crosses_a_line_of_double_zeros) {
  // K is a positive multiple of (12 x^2 - 0.6) y^2: it changes its sign where x is +- sqrt(0.05), and not where y is 0.
  const auto traits = formula("z-x^4-y^4+.3*x^2-.2", CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  for (const std::size_t nodes : {29, 30, 41}) { // an odd grid has vertices on the line y = 0
    const auto curves = parabolic_curves(surface_of(traits, {.resolution = nodes}), traits);
    EXPECT_EQ(curves.unconverged_points, 0u) << nodes;
    EXPECT_EQ(curves.polylines.size(), 2u) << nodes;
    for (const auto& line : curves.polylines)
      for (const Point_3& p : line.points) {
        if (std::abs(p.y()) < 1e-15) continue;
        EXPECT_NEAR(std::abs(p.x()), std::sqrt(0.05), 1e-9) << p;
      }
  }
}

TEST(Parabolic_curves, where_the_curvature_is_zero_but_for_rounding_there_are_none) {
  for (const char* text : {"z^2-x^2-y^2", "(x+.3*z)^2+(y-.2*x)^2-.5", "z-sin(x+2*y)"}) {
    const auto traits = formula(text, CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
    const auto surface = surface_of(traits, {.resolution = 30});
    EXPECT_TRUE(parabolic_curves(surface, traits).polylines.empty()) << text;
  }
}

TEST(Parabolic_curves, the_function_is_the_gaussian_curvature_times_a_power_of_the_gradient) {
  const auto f = [](const auto& x, const auto& y, const auto& z) {
    using std::sin;
    return x * x * y + sin(z * x) + 2.0 * z - y * y * y;
  };
  const auto at = [&](double x, double y, double z) {
    return internal::parabolic_function(expand<4, double>(f, x, y, z));
  };
  const double x = 0.4, y = -0.7, z = 0.3, h = 1e-5;
  const auto jet = expand<4, double>(f, x, y, z);
  const double g2 = std::pow(jet.coefficient(1, 0, 0), 2) + std::pow(jet.coefficient(0, 1, 0), 2) +
                    std::pow(jet.coefficient(0, 0, 1), 2);
  EXPECT_NEAR(at(x, y, z).value(), local_structure(jet).euclidean.gaussian_curvature * g2 * g2, 1e-12);
  EXPECT_NEAR(at(x, y, z).coefficient(0, 0, 1), (at(x, y, z + h).value() - at(x, y, z - h).value()) / (2 * h), 1e-8);
  EXPECT_NEAR(at(x, y, z).coefficient(1, 0, 0), (at(x + h, y, z).value() - at(x - h, y, z).value()) / (2 * h), 1e-8);
}

TEST(Parabolic_curves, curves_that_cross_end_where_they_do) {
  const auto traits = formula("z-sin(x)*sin(y)", CGAL::Bbox_3(-1.1, -1.2, -1, 2.9, 1.3, 1.5));
  const auto curves = parabolic_curves(surface_of(traits, {.resolution = 30}), traits);
  int arms = 0;
  for (const auto& line : curves.polylines) {
    EXPECT_FALSE(line.is_closed);
    for (const Point_3& p : {line.points.front(), line.points.back()})
      arms += CGAL::squared_distance(p, Point_3(CGAL_PI / 2, 0, 0)) < 1e-24;
  }
  EXPECT_EQ(arms, 4) << "two curves cross at (pi/2, 0)";
  EXPECT_EQ(curves.unconverged_points, 0u);
}

TEST(Parabolic_curves, curves_end_where_the_surface_leaves_the_box_and_threads_change_nothing) {
  const auto traits = formula("z-.3*sin(3*x)*(1+.1*y^2)-.3*y^2", CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const auto surface = surface_of(traits, {.resolution = 30});
  const auto curves = parabolic_curves(surface, traits),
             parallel = parabolic_curves<CGAL::Parallel_if_available_tag>(surface, traits);
  ASSERT_FALSE(curves.polylines.empty());
  for (std::size_t n = 0; n < curves.polylines.size(); ++n) {
    EXPECT_FALSE(curves.polylines[n].is_closed);
    EXPECT_EQ(curves.polylines[n].points, parallel.polylines[n].points);
    for (const Point_3& p : curves.polylines[n].points)
      EXPECT_NEAR(local_structure(traits.taylor(p)).euclidean.gaussian_curvature, 0, 1e-12);
  }
}

TEST(Parabolic_curves, convex_surfaces_have_none) {
  const auto traits = formula("x^2+y^2+z^2-1", CGAL::Bbox_3(-2, -2, -2, 2, 2, 2));
  EXPECT_TRUE(parabolic_curves(surface_of(traits, {.resolution = 20}), traits).polylines.empty());
}

TEST(Write_curves, closed_curves_end_with_their_first_point_and_open_ones_do_not) {
  const Parabolic_curves_3<Kernel> curves{
      {{{{0, 0, 0}, {1, 0, 0}, {0.1, 1, 0}}, true}, {{{0, 0, 1}, {1, 0, 1}}, false}}};
  std::ostringstream text;
  write_OBJ(text, curves);
  EXPECT_EQ(text.str(), "v 0 0 0\nv 1 0 0\nv 0.10000000000000001 1 0\nv 0 0 1\nv 1 0 1\nl 1 2 3 1\nl 4 5\n");
}

} // namespace parabolic_curves_test
