// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

namespace Transformed_function_traits_3_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Map = Kernel::Aff_transformation_3;

const CGAL::Bbox_3 box(-2, -2, -2, 2, 2, 2);

// The condition of the map is 4e5; one rounding of its entries, or of the coordinates, changes the normal by 2e-11. The
// values are from 70-digit arithmetic.
TEST(Transformed_function_traits_3, keeps_its_digits_under_ill_conditioned_maps) {
  const Map map(1, 1, 1, 1, 1.00001, 1, 1, 1, 1.00003);
  const Kernel::Point_3 p(1, 1.00001, 1.00002);
  const auto f = make_analytic_traits<Kernel>(Expression_3("x^3+y^2*z-sin(x*z)"), box);
  const auto s = local_structure(Transformed_function_traits_3(f, map).taylor(p)).euclidean;
  EXPECT_NEAR(s.normal[0], -0.80036556321724134, 1e-10);
  EXPECT_NEAR(s.normal[1], 0.54003811925714001, 1e-10);
  EXPECT_NEAR(s.normal[2], 0.26033400654766384, 1e-10);
  EXPECT_NEAR(s.gaussian_curvature / 1.3796793109142784, 1, 2e-6) << "more is lost in the second derivatives";
  const auto x = make_analytic_traits<Kernel>(Expression_3("x"), box);
  EXPECT_NEAR(Transformed_function_traits_3(x, map).value(p), -0.6666666666642, 1e-10);
  const Map shifted(1, 1, 1, 0.5, 1, 1.00001, 1, 0.25, 1, 1, 1.00003, -2);
  EXPECT_NEAR(Transformed_function_traits_3(x, shifted).value(Kernel::Point_3(1.5, 1.25001, -0.99998)),
              -0.6666666666642, 1e-10);
}

TEST(Transformed_function_traits_3, inverts_simple_maps_as_before) {
  const auto f = make_analytic_traits<Kernel>(Expression_3("x+8*y+64*z"), box);
  const Kernel::Point_3 p(0.7, -0.3, 0.1);
  const auto value = [&](const Map& map) { return Transformed_function_traits_3(f, map).value(p); };
  EXPECT_EQ(value(Map(0, -1, 0, 1, 0, 0, 0, 0, 1)), f.value(Kernel::Point_3(-0.3, -0.7, 0.1)));
  EXPECT_EQ(value(Map(CGAL::SCALING, 0.5)), f.value(Kernel::Point_3(1.4, -0.6, 0.2)));
  EXPECT_EQ(value(Map(CGAL::TRANSLATION, Kernel::Vector_3(0.1, 0.2, 0.3))),
            f.value(Kernel::Point_3(0.7 - 0.1, -0.3 - 0.2, 0.1 - 0.3)));
  EXPECT_DOUBLE_EQ(value(Map(1e200, 0, 0, 0, 1e-200, 0, 0, 0, 1)),
                   f.value(Kernel::Point_3(0.7e-200, -0.3 / 1e-200, 0.1)));
}

} // namespace Transformed_function_traits_3_test
