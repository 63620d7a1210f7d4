// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/surface/distance_to_surface.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace distance_to_surface_test {

using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

const CGAL::Bbox_3 box(-1, -1, -1, 1, 1, 1);

const auto scaled_plane = equiaffine::make_analytic_traits<Kernel>(
    [](const auto& x, const auto& y, const auto& z) { return 3.0 * x + 4.0 * y + 0.0 * z; }, box);
const auto square_root = equiaffine::make_analytic_traits<Kernel>(
    [](const auto& x, const auto& y, const auto& z) {
      using std::sqrt;
      return sqrt(x) - 1.0 + 0.0 * y + 0.0 * z;
    },
    box);

TEST(Distance_to_surface, is_the_greatest_euclidean_distance_for_a_plane_whatever_the_scale_of_f) {
  const std::vector<Point_3> points = {{0, 0, 5}, {3, 4, 1}, {-6, -8, 0}, {1, 0, 0}};
  EXPECT_DOUBLE_EQ(equiaffine::max_distance_to_surface(scaled_plane, points), 10);
}

TEST(Distance_to_surface, skips_points_where_f_is_undefined) {
  const std::vector<Point_3> points = {{-1, 0, 0}, {4, 0, 0}, {-2, 0, 0}, {1, 0, 0}};
  EXPECT_DOUBLE_EQ(equiaffine::max_distance_to_surface(square_root, points), 4); // |2 - 1| / (1 / (2 sqrt 4))
}

TEST(Distance_to_surface, does_not_exist_without_a_point_where_f_is_defined) {
  EXPECT_TRUE(std::isnan(equiaffine::max_distance_to_surface(square_root, std::vector<Point_3>{{-1, 0, 0}})));
  EXPECT_TRUE(std::isnan(equiaffine::max_distance_to_surface(square_root, std::vector<Point_3>{})));
}

TEST(Distance_to_surface, skips_points_that_are_unconverged) {
  using equiaffine::Point_status;
  const std::vector<Point_3> points = {{0, 0, 5}, {3, 4, 1}, {-6, -8, 0}};
  std::vector<Point_status> status = {Point_status::REGULAR, Point_status::SINGULAR, Point_status::UNCONVERGED};
  EXPECT_DOUBLE_EQ(equiaffine::max_distance_to_surface(scaled_plane, points, status), 5);
  status.assign(3, Point_status::UNCONVERGED);
  EXPECT_TRUE(std::isnan(equiaffine::max_distance_to_surface(scaled_plane, points, status)));
  status.pop_back();
  EXPECT_THROW(equiaffine::max_distance_to_surface(scaled_plane, points, status), std::invalid_argument);
}

TEST(Distance_to_surface, is_unknown_beside_a_pole) {
  using equiaffine::Expression_3, equiaffine::make_analytic_traits, equiaffine::max_distance_to_surface;
  for (const char* text : {"1/x", "1/x^3", "1/(x-y)", "x/abs(x)^1.25", "1/x+y/100"})
    for (const double x : {1e-16, 1e-12, 1e-9, 1e-6, 1e-3, 0.1})
      for (const int side : {-1, 1}) {
        const std::vector<Point_3> points = {{side * x, 0, 0.7},
                                             {100, -1, 0}}; // the second makes the greatest coordinate large
        EXPECT_TRUE(std::isnan(max_distance_to_surface(make_analytic_traits<Kernel>(Expression_3(text), box), points)))
            << text << " at " << points[0];
      }
}

TEST(Distance_to_surface, is_known_beside_zeros_of_any_order) {
  using equiaffine::Expression_3, equiaffine::make_analytic_traits, equiaffine::max_distance_to_surface;
  struct Case {
    const char* text;
    int order;
  };
  for (const auto& [text, order] :
       {Case{"x", 1}, Case{"x^2", 2}, Case{"x^3", 3}, Case{"x^6", 6}, Case{"sin(x)", 1}, Case{"x*(3+cos(y))", 1}})
    for (const double x : {1e-16, 1e-12, 1e-9, 1e-8, 3e-8, 1e-7, 1e-6, 1e-3, 0.1})
      for (const int side : {-1, 1}) {
        const std::vector<Point_3> points = {{side * x, 0.2, 0.7}};
        EXPECT_NEAR(max_distance_to_surface(make_analytic_traits<Kernel>(Expression_3(text), box), points), x / order,
                    x / 100)
            << text << " at " << points[0];
      }
  // Rounding alone decides these values.
  const auto sphere = make_analytic_traits<Kernel>(Expression_3("(x-1000)^2+y^2+z^2-1"), box);
  std::vector<Point_3> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(1000 + std::cos(i), std::sin(i) * 0.6, std::sin(i) * 0.8);
  EXPECT_LE(max_distance_to_surface(sphere, points), 1e-12);
}

TEST(Distance_to_surface, does_not_depend_on_threads) {
  std::vector<Point_3> points;
  for (int i = 0; i < 10000; ++i) points.emplace_back(std::sin(i), std::cos(3 * i), 0);
  EXPECT_EQ(equiaffine::max_distance_to_surface<CGAL::Sequential_tag>(scaled_plane, points),
            equiaffine::max_distance_to_surface<CGAL::Parallel_if_available_tag>(scaled_plane, points));
}

} // namespace distance_to_surface_test
