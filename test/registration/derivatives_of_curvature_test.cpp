// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration/Framed_surface_3.h"
#include "support/points_on_surface.h"
#include "support/registration_cases.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace derivatives_of_curvature_test {

using namespace equiaffine;
using namespace registration_cases;

TEST(Derivatives_of_curvature, they_agree_with_differences_along_principal_directions) {
  constexpr double step = 1e-4;
  for (const Surface& surface : generic_surfaces()) {
    const Formula formula = surface.traits();
    const internal::Framed_function_3 oracle(Any_function_3::make(formula));
    const auto at = [&](const Eigen::Vector3d& p) {
      return internal::derivatives_of_curvature(formula.taylor(Point_3(p[0], p[1], p[2])));
    };
    const auto points = points_on_surface(formula, 9);
    const Point_3 point = *std::min_element(points.begin(), points.end(), [](const Point_3& a, const Point_3& b) {
      return CGAL::squared_distance(a, Point_3(0, 0, 0)) < CGAL::squared_distance(b, Point_3(0, 0, 0));
    }); // away from the sides of the box
    const Eigen::Vector3d p(point.x(), point.y(), point.z());
    const auto here = at(p);
    for (int d = 0; d < 2; ++d) {
      const Eigen::Vector3d move = step * here.directions.col(d);
      const Eigen::Vector2d slope =
          (at(oracle.moved_to_surface(p + move, 5)).k - at(oracle.moved_to_surface(p - move, 5)).k) / (2 * step);
      EXPECT_LT((here.gradient.col(d) - slope).norm(), 1e-5 * (1 + here.gradient.norm())) << surface.name;
    }
  }
}

} // namespace derivatives_of_curvature_test
