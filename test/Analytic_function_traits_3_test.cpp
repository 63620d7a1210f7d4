// SPDX-License-Identifier: GPL-3.0-or-later
// What the conformance suite does not ask of every model.
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/Expression_3.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

/// By how much bounds of value and gradient on the box of half side r about p are wider than the ranges of their linear
/// parts, which are the true ranges up to terms of order r^2.
template <class Bounds>
std::array<double, 4> excess(const Bounds& bounds, const Jet_3<double>& jet, double r) {
  std::array<double, 4> result{};
  for (int c = 0; c < 4; ++c) {
    const auto& b = bounds.coefficients()[std::size_t(c)];
    double slopes = 0;
    for (int a = 1; a < 4; ++a)
      slopes += std::abs(jet.derivative((a == 1) + (c == 1), (a == 2) + (c == 2), (a == 3) + (c == 3)));
    result[std::size_t(c)] = std::abs(b.upper() - b.lower() - 2 * r * slopes);
  }
  return result;
}

TEST(Analytic_function_traits, mean_value_bounds_exceed_the_range_by_the_square_of_the_box) {
  const auto traits = make_analytic_traits<Kernel>(Expression_3("exp(x)*sin(2*y) + x*z^2/(2+x*y) - 0.3*x*y"),
                                                   CGAL::Bbox_3(-1, -1, -1, 1, 1, 1));
  for (const Point_3& p : {Point_3(0.1, 0.2, 0.3), Point_3(-0.45, 0.31, 0.62), Point_3(0.7, -0.13, -0.28)}) {
    const auto jet = traits.taylor(p);
    const auto on_box = [&](double r) {
      const CGAL::Bbox_3 box(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r);
      return std::pair(excess(traits.first_order_bounds(box), jet, r), excess(traits.mean_value_bounds(box), jet, r));
    };
    const double ratio = 16;
    const auto large = on_box(0.02), small = on_box(0.02 / ratio);
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_LT(small.second[c], 1.5 / (ratio * ratio) * large.second[c]) << p << " coefficient " << c;
      EXPECT_GT(small.first[c], 0.5 / ratio * large.first[c]) << "the usual bounds exceed it by a multiple of the box";
    }
  }
}

} // namespace
