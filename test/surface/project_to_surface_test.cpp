// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/contraction.h"
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/formula/analytic_functions.h>
#include <equiaffine/function/Analytic_function_traits_3.h>
#include <equiaffine/function/internal/intersect_segments.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Simple_cartesian.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace project_to_surface_test {

using namespace equiaffine;
using Kernel = CGAL::Simple_cartesian<double>;
using Point_3 = Kernel::Point_3;

/// A model without derivatives of order 1 alone.
template <class Function>
struct Values_only {
  using FT = double;
  using Point_3 = project_to_surface_test::Point_3;
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
      EXPECT_TRUE(root.is_at_pole) << text;
    }
  }
}

/// Is x - 0.3 up to `smooth_end`, and 1 without derivatives beyond.
struct Ending_function {
  using FT = double;
  using Point_3 = project_to_surface_test::Point_3;
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

/// This function is negative in a ball and branches at x = y, so that points on both sides disagree in a pack.
struct Branching_function {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    const T square = x * x + y * y + z * z - 1.0;
    return x < y ? square : square * (2.0 + z);
  }
};

std::vector<Point_3> random_points(std::size_t n) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-2, 2);
  std::vector<Point_3> points;
  while (points.size() < n) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    points.emplace_back(x, y, z);
  }
  return points;
}

template <class Function>
void expect_batches_of_single_calls(const Function& f) {
  const Batch_function_traits_3 traits(with_derivatives(f));
  for (const std::size_t n : {0, 1, 7, 63, 64, 65, 200}) {
    const auto points = random_points(n);
    std::vector<double> values(n);
    std::vector<Jet_3<double, 1>> jets(n);
    traits.values(points, values);
    traits.first_orders(points, jets);
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(values[i], traits.value(points[i])) << n;
      ASSERT_EQ(jets[i].coefficients(), traits.first_order(points[i]).coefficients()) << n;
    }
  }
}

TEST(Batch_function_traits_3, batches_of_any_size_are_single_calls) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  expect_batches_of_single_calls(analytic_functions::Tanglecube());
  expect_batches_of_single_calls(Branching_function());
  expect_batches_of_single_calls(Expression_3("min(x^2+y^2+z^2-1, exp(x)-2*y, abs(z)-x)"));
}

struct Segment {
  std::array<Point_3, 2> ends;
  std::array<double, 2> values;
};

/// Intersects `count` segments together and one by one. Returns how many have a root, and how many end at a pole.
template <class Traits>
std::array<std::size_t, 2> expect_searches_of_single_calls(const Traits& traits, std::size_t count) {
  std::vector<Segment> segments;
  const auto points = random_points(40 * count + 100);
  for (std::size_t i = 0; i + 1 < points.size() && segments.size() < count; i += 2) {
    const double fa = traits.value(points[i]), fb = traits.value(points[i + 1]);
    if ((fa < 0) != (fb < 0)) segments.push_back({{points[i], points[i + 1]}, {fa, fb}});
  }
  EXPECT_EQ(segments.size(), count);
  const auto together = intersect_segments(Batch_function_traits_3(traits), std::span<const Segment>(segments));
  EXPECT_EQ(together.size(), count);
  std::array<std::size_t, 2> roots_and_poles{};
  for (std::size_t n = 0; n < count; ++n) {
    const auto& [ends, values] = segments[n];
    const auto alone = intersect_segment(traits, ends[0], ends[1], values[0], values[1]);
    EXPECT_EQ(together[n].point, alone.point) << n;
    EXPECT_EQ(together[n].has_converged, alone.has_converged) << n;
    EXPECT_EQ(together[n].is_at_pole, alone.is_at_pole) << n;
    EXPECT_EQ(together[n].is_at_end, alone.is_at_end) << n;
    EXPECT_EQ(together[n].evaluations, alone.evaluations) << n;
    roots_and_poles[0] += alone.has_converged;
    roots_and_poles[1] += alone.is_at_pole;
  }
  return roots_and_poles;
}

TEST(Intersect_segments, searches_together_are_searches_alone) {
  SKIP_IF_THE_COMPILER_CONTRACTS();
  for (const std::size_t n : {0, 1, 63, 64, 65, 200}) {
    expect_searches_of_single_calls(with_derivatives(Branching_function()), n);
    expect_searches_of_single_calls(Values_only<analytic_functions::Tanglecube>{{}}, n);
  }
  const auto [roots, poles] = expect_searches_of_single_calls(with_derivatives(Expression_3("y+1/(x-0.01)")), 200);
  EXPECT_GT(roots, 20u);
  EXPECT_GT(poles, 20u);
  EXPECT_EQ(expect_searches_of_single_calls(Ending_function{0.29}, 20), (std::array<std::size_t, 2>{0, 0}));
}

} // namespace project_to_surface_test
