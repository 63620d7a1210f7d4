// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Sampled_function_traits_3.h>
#include <equiaffine/function/isosurfacing_fields.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#if __has_include(<CGAL/Isosurfacing_3/marching_cubes_3.h>) // CGAL 6.1
#include <CGAL/Isosurfacing_3/Cartesian_grid_3.h>
#include <CGAL/Isosurfacing_3/Dual_contouring_domain_3.h>
#include <CGAL/Isosurfacing_3/Gradient_function_3.h>
#include <CGAL/Isosurfacing_3/Marching_cubes_domain_3.h>
#include <CGAL/Isosurfacing_3/Value_function_3.h>
#include <CGAL/Isosurfacing_3/dual_contouring_3.h>
#include <CGAL/Isosurfacing_3/marching_cubes_3.h>
#endif

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace isosurfacing_fields_test {

using namespace equiaffine;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel; // another one than that of the function
using Point_3 = Kernel::Point_3;

constexpr double level = 0.3;

/// A function whose zero set is an ellipsoid, and whose level sets no piecewise linear function has.
const auto traits = make_analytic_traits<CGAL::Simple_cartesian<double>>(
    [](const auto& x, const auto& y, const auto& z) { return x * x / 4.0 + y * y + 2.0 * z * z - 1.0; },
    CGAL::Bbox_3(-2.6, -1.5, -1.1, 2.6, 1.5, 1.1));

double value_at(const Point_3& p) { return p.x() * p.x() / 4 + p.y() * p.y() + 2 * p.z() * p.z() - 1; }

TEST(Isosurfacing_fields, have_values_and_unit_gradients_in_another_kernel) {
  const Point_3 p(0.7, -0.4, 0.3);
  EXPECT_DOUBLE_EQ(Value_of_function_3(traits)(p), value_at(p));
  const Kernel::Vector_3 expected(p.x() / 2, 2 * p.y(), 4 * p.z());
  const Kernel::Vector_3 gradient = Gradient_of_function_3(traits)(p);
  EXPECT_NEAR(gradient.squared_length(), 1, 1e-15);
  EXPECT_NEAR(gradient * expected, std::sqrt(expected.squared_length()), 1e-15);
  EXPECT_EQ(Gradient_of_function_3(traits)(Point_3(0, 0, 0)), CGAL::NULL_VECTOR);
}

TEST(Isosurfacing_fields, put_the_ends_of_an_edge_to_where_the_level_set_passes) {
  const Edge_intersection_of_function_3 passes(traits);
  const Point_3 inside(0.1, 0.2, 0.1), outside(2.4, 0.9, 0.4);
  Point_3 p;
  EXPECT_FALSE(passes(inside, inside, value_at(inside), value_at(inside), 0, level, p));
  ASSERT_TRUE(passes(inside, outside, value_at(inside), value_at(outside), 0, level, p));
  EXPECT_NEAR(value_at(p), level, 1e-15);
  EXPECT_NEAR(CGAL::cross_product(outside - inside, p - inside).squared_length(), 0, 1e-28);
}

#if __has_include(<CGAL/Isosurfacing_3/marching_cubes_3.h>)

namespace IS = CGAL::Isosurfacing;
using Grid = IS::Cartesian_grid_3<Kernel>;

Grid grid() { return Grid(traits.bbox(), CGAL::make_array<std::size_t>(30, 25, 20)); }

TEST(Isosurfacing_fields, give_CGALs_marching_cubes_values) {
  const Grid cells = grid();
  const IS::Value_function_3<Grid> values{Value_of_function_3(traits), cells};
  std::vector<Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  IS::marching_cubes(IS::create_marching_cubes_domain_3(cells, values), level, points, triangles);
  ASSERT_GT(triangles.size(), 1000U);
  for (const Point_3& p : points) EXPECT_NEAR(value_at(p), level, 0.01); // linear along edges
}

TEST(Isosurfacing_fields, give_CGALs_dual_contouring_gradients_and_points_of_edges_on_the_surface) {
  const Grid cells = grid();
  const IS::Value_function_3<Grid> values{Value_of_function_3(traits), cells};
  const IS::Gradient_function_3<Grid> gradients{Gradient_of_function_3(traits), cells};
  const auto domain =
      IS::create_dual_contouring_domain_3(cells, values, gradients, Edge_intersection_of_function_3(traits));
  const Point_3 inside(0.1, 0.2, 0.1), outside(2.4, 0.9, 0.4);
  Point_3 on_edge;
  ASSERT_TRUE(domain.construct_intersection(inside, outside, value_at(inside), value_at(outside), level, on_edge));
  EXPECT_NEAR(value_at(on_edge), level, 1e-15);
  std::vector<Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
  IS::dual_contouring(domain, level, points, polygons);
  ASSERT_GT(polygons.size(), 500U);
  for (const Point_3& p : points) EXPECT_NEAR(value_at(p), level, 0.05);
}

TEST(Isosurfacing_fields, of_CGAL_are_functions_with_derivatives_once_sampled) {
  const Grid cells = grid();
  const IS::Value_function_3<Grid> values{Value_of_function_3(traits), cells};
  const auto volume = sampled_field(values, cells);
  const Sampled_function_traits_3<CGAL::Simple_cartesian<double>> sampled(volume);
  const CGAL::Simple_cartesian<double>::Point_3 p(0.7, -0.4, 0.3);
  EXPECT_NEAR(sampled.value(p), traits.value(p), 1e-9);
  const auto expected = traits.taylor(p).coefficients(), found = sampled.taylor(p).coefficients();
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-6) << i;
}

#endif

} // namespace isosurfacing_fields_test
