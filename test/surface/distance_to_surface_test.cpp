// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/surface/distance_to_surface.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace {

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

} // namespace

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

TEST(Distance_to_surface, does_not_depend_on_threads) {
  std::vector<Point_3> points;
  for (int i = 0; i < 10000; ++i) points.emplace_back(std::sin(i), std::cos(3 * i), 0);
  EXPECT_EQ(equiaffine::max_distance_to_surface<CGAL::Sequential_tag>(scaled_plane, points),
            equiaffine::max_distance_to_surface<CGAL::Parallel_tag>(scaled_plane, points));
}
