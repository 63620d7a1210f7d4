// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/surface/Clip_domain_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace Clip_domain_3_test {

using equiaffine::Clip_domain_3;

TEST(Clip_domain, what_bounds_nothing_is_refused_in_every_build) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const CGAL::Bbox_3& box : {CGAL::Bbox_3(), CGAL::Bbox_3(0, 0, 0, 1, 0, 1), CGAL::Bbox_3(0, 0, 0, infinity, 1, 1),
                                  CGAL::Bbox_3(0, 0, 0, 1, nan, 1)})
    EXPECT_THROW(Clip_domain_3{box}, std::invalid_argument) << box;
  for (const double radius : {-1.0, 0.0, infinity, nan})
    EXPECT_THROW(Clip_domain_3({0, 0, 0}, radius), std::invalid_argument) << radius;
  EXPECT_THROW(Clip_domain_3({0, infinity, 0}, 1), std::invalid_argument);
}

TEST(Clip_domain, a_ball_is_given_by_a_point_or_a_sphere_of_any_kernel) {
  using Kernel = CGAL::Simple_cartesian<float>;
  const Clip_domain_3 ball({1, 2, 3}, 4);
  for (const Clip_domain_3& other :
       {Clip_domain_3(Kernel::Point_3(1, 2, 3), 4), Clip_domain_3(Kernel::Sphere_3(Kernel::Point_3(1, 2, 3), 16))}) {
    EXPECT_EQ(other.center(), ball.center());
    EXPECT_EQ(other.radius(), 4);
    EXPECT_EQ(other.bbox(), ball.bbox());
  }
  EXPECT_THROW(Clip_domain_3(Kernel::Point_3(0, 0, 0), -1), std::invalid_argument);
}

} // namespace Clip_domain_3_test
