// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/Analytic_function_traits_3.h>
#include <equiaffine/Expression_3.h>
#include <equiaffine/analytic_functions.h>
#include <equiaffine/project_to_surface.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

/// A model without derivatives of order 1 alone.
template <class Function>
struct Values_only {
  using FT = double;
  using Point_3 = ::Point_3;
  using Vector_3 = Kernel::Vector_3;
  double value(const Point_3& p) const { return function(p.x(), p.y(), p.z()); }
  Jet_3<double> taylor(const Point_3&) const {
    ADD_FAILURE() << "an expansion of order 4 where a value is enough";
    return Jet_3<double>(0.0);
  }
  CGAL::Bbox_3 bbox() const { return CGAL::Bbox_3(-3, -3, -3, 3, 3, 3); }
  Function function;
};

template <class Function>
auto with_derivatives(const Function& f) {
  return make_analytic_traits<Kernel>(f, CGAL::Bbox_3(-3, -3, -3, 3, 3, 3));
}

/// Judges roots on random segments with a sign change by their distance and the mean number of evaluations.
template <class Traits, class Function>
void expect_exact_roots(const Traits& traits, const Function& f, double most_evaluations) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  const auto point = [&] { return Point_3(coordinate(random), coordinate(random), coordinate(random)); };
  std::size_t roots = 0, evaluations = 0;
  while (roots < 2000) {
    const Point_3 a = point(), b = point();
    const double fa = traits.value(a), fb = traits.value(b);
    if ((fa < 0) == (fb < 0)) continue;
    const auto root = intersect_segment(traits, a, b, fa, fb);
    ASSERT_TRUE(root.has_converged);
    ASSERT_LE(distance_estimate(first_order(with_derivatives(f), root.point)), 1e-14);
    evaluations += root.evaluations;
    ++roots;
  }
  EXPECT_LE(double(evaluations) / double(roots), most_evaluations);
}

TEST(Intersect_segment, roots_are_exact_with_derivatives_and_without) {
  const analytic_functions::Tanglecube f;
  expect_exact_roots(with_derivatives(f), f, 8);
  expect_exact_roots(Values_only<analytic_functions::Tanglecube>{f}, f, 10);
}

TEST(Intersect_segment, poles_and_jumps_are_not_roots) {
  const Point_3 a(-1, 0, 0), b(1, 0, 0);
  for (const char* text : {"1/(x-0.01)", "(x-0.01)/abs(x-0.01)"}) {
    const Expression_3 f(text);
    const double fa = f(-1.0, 0.0, 0.0), fb = f(1.0, 0.0, 0.0);
    for (const auto& root : {intersect_segment(with_derivatives(f), a, b, fa, fb),
                             intersect_segment(Values_only<Expression_3>{f}, a, b, fa, fb)}) {
      EXPECT_FALSE(root.has_converged) << text;
      EXPECT_EQ(root.is_at_pole, text[0] == '1') << text;
    }
  }
}

/// Is x - 0.3 up to `smooth_end`, and 1 without derivatives beyond.
struct Ending_function {
  using FT = double;
  using Point_3 = ::Point_3;
  using Vector_3 = Kernel::Vector_3;
  double value(const Point_3& p) const { return p.x() > smooth_end ? 1 : p.x() - 0.3; }
  Jet_3<double, 1> first_order(const Point_3& p) const {
    if (p.x() > smooth_end) return Jet_3<double, 1>(std::numeric_limits<double>::quiet_NaN());
    Jet_3<double, 1> jet(p.x() - 0.3);
    jet.coefficients()[1] = 1;
    return jet;
  }
  Jet_3<double> taylor(const Point_3&) const { return {}; }
  CGAL::Bbox_3 bbox() const { return CGAL::Bbox_3(-3, -3, -3, 3, 3, 3); }
  double smooth_end;
};

TEST(Intersect_segment, a_surface_ends_where_derivatives_do) {
  const Point_3 a(-1, 0, 0), b(1, 0, 0);
  const auto found = intersect_segment(Ending_function{0.31}, a, b, -1.3, 1.);
  EXPECT_TRUE(found.has_converged && !found.is_at_end);
  EXPECT_NEAR(found.point.x(), 0.3, 1e-15);
  const auto missed = intersect_segment(Ending_function{0.29}, a, b, -1.3, 1.);
  EXPECT_TRUE(!missed.has_converged && missed.is_at_end && !missed.is_at_pole);
}

TEST(Intersect_segment, a_triple_root_is_found) {
  const Expression_3 f("(x-0.3)^3");
  const Point_3 a(-1, 0, 0), b(1, 0, 0);
  const double fa = f(-1.0, 0.0, 0.0), fb = f(1.0, 0.0, 0.0);
  EXPECT_NEAR(intersect_segment(with_derivatives(f), a, b, fa, fb).point.x(), 0.3, 1e-12);
  EXPECT_NEAR(intersect_segment(Values_only<Expression_3>{f}, a, b, fa, fb).point.x(), 0.3, 1e-12);
}

} // namespace
