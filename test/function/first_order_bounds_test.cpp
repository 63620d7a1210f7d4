// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/capabilities.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace first_order_bounds_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

/// The largest excess of four bounds, those of value and gradient on the box of half side r about p, over the ranges of
/// the linear parts, which are the true ranges up to terms of order r^2.
double excess(const Jet_3<Interval, 1>& bounds, const Jet_3<double>& jet, double r) {
  double largest = 0;
  for (int c = 0; c < 4; ++c) {
    const Interval& b = bounds.coefficients()[std::size_t(c)];
    double slopes = 0;
    for (int a = 1; a < 4; ++a)
      slopes += std::abs(jet.derivative((a == 1) + (c == 1), (a == 2) + (c == 2), (a == 3) + (c == 3)));
    largest = std::max(largest, std::abs(b.upper() - b.lower() - 2 * r * slopes));
  }
  return largest;
}

template <class Traits>
void expect_quadratic_excess(const Traits& traits, const Point_3& p) {
  const auto jet = traits.taylor(p);
  const double large = 0.01, ratio = 16, small = large / ratio;
  const auto box = [&](double r) {
    return CGAL::Bbox_3(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r);
  };
  const auto tight = [&](double r) { return excess(tight_first_order_bounds(traits, box(r)), jet, r); };
  const auto usual = [&](double r) { return excess(traits.first_order_bounds(box(r)), jet, r); };
  EXPECT_LT(tight(small), 1.5 / (ratio * ratio) * tight(large)) << p;
  EXPECT_GT(usual(small), 0.5 / ratio * usual(large)) << "the usual ones by a multiple of the box";
}

TEST(First_order_bounds, tight_ones_exceed_the_range_by_the_square_of_the_box_also_those_of_an_image) {
  const auto traits = make_analytic_traits<Kernel>(Expression_3("exp(x)*sin(2*y) + x*z^2/(2+x*y) - 0.3*x*y"),
                                                   CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  const Kernel::Aff_transformation_3 map(0.9, 0, 0.9, 0.5, 0, 2, 0.1, -1, 1.1, 0, 0.6, 2);
  for (const Point_3& p : {Point_3(0.1, 0.2, 0.3), Point_3(-0.45, 0.31, 0.62), Point_3(0.7, -0.13, -0.28)}) {
    expect_quadratic_excess(traits, p);
    expect_quadratic_excess(Level_set_traits_3(traits, 0.25, Orientation_of_level_set::AGAINST_GRADIENT), p);
    expect_quadratic_excess(Transformed_function_traits_3(traits, map), map(p));
  }
}

} // namespace first_order_bounds_test
