// SPDX-License-Identifier: GPL-3.0-or-later
// A suite of tests for what models of ImplicitFunctionTraits_3 promise beyond its syntax. A parameter of the suite is a
// type with
//   using Traits; static Traits make(); static std::vector<Point_3> points();   // in the box, where f is smooth
//   static constexpr double length;                                             // over which f varies by its own size
//   static constexpr bool is_unbounded = true;   // optional: bounds say where f has no value, and no more
#ifndef EQUIAFFINE_TEST_SUPPORT_CONFORMANCE_H
#define EQUIAFFINE_TEST_SUPPORT_CONFORMANCE_H

#include "support/contraction.h"
#include <equiaffine/Batch_function_traits_3.h>
#include <equiaffine/concepts.h>
#include <equiaffine/function/first_order_bounds.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <random>
#include <thread>
#include <vector>

namespace conformance {

using equiaffine::Jet_3;

inline double evaluate(const Jet_3<double>& jet, double x, double y, double z) {
  double sum = 0;
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j)
      for (int k = 0; i + j + k <= 4; ++k)
        sum += jet.coefficient(i, j, k) * std::pow(x, i) * std::pow(y, j) * std::pow(z, k);
  return sum;
}

/// The largest difference between f and its expansion on a set of directions at distance h, relative to the size of the
/// terms.
template <class Traits>
double remainder(const Traits& traits, const typename Traits::Point_3& p, double h) {
  static const std::array<std::array<double, 3>, 7> directions = {
      {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {.6, -.64, .48}, {-.48, .6, .64}, {.64, .48, -.6}, {-.57, -.57, -.6}}};
  const auto jet = traits.taylor(p);
  double size = 0, worst = 0;
  for (int n = 0; n < 35; ++n)
    size += std::abs(jet.coefficients()[std::size_t(n)]) *
            std::pow(h, equiaffine::internal::monomials[std::size_t(n)].degree());
  for (const auto& d : directions) {
    const typename Traits::Point_3 q(p.x() + h * d[0], p.y() + h * d[1], p.z() + h * d[2]);
    const double predicted = evaluate(jet, q.x() - p.x(), q.y() - p.y(), q.z() - p.z());
    worst = std::max(worst, std::abs(traits.value(q) - predicted));
  }
  return worst / size;
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// The cube around p whose sides are 2 r.
template <class Point_3>
CGAL::Bbox_3 cube(const Point_3& p, double r) {
  return CGAL::Bbox_3(p.x() - r, p.y() - r, p.z() - r, p.x() + r, p.y() + r, p.z() + r);
}

template <class Point_3>
Point_3 random_point_in_cube(const Point_3& p, double r, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return Point_3(p.x() + r * unit(random), p.y() + r * unit(random), p.z() + r * unit(random));
}

/// Expects the expansion at q, which is not rounded outwards, in the bounds up to a relative error.
template <class Jet, class Bounds, class Point_3>
void expect_enclosed(const Jet& jet, const Bounds& bounds, double relative_error, const Point_3& q) {
  for (std::size_t c = 0; c < bounds.coefficients().size(); ++c) {
    const double rounding = relative_error * (1 + std::abs(jet.coefficients()[c]));
    EXPECT_GE(jet.coefficients()[c], bounds.coefficients()[c].lower() - rounding) << "coefficient " << c << " at " << q;
    EXPECT_LE(jet.coefficients()[c], bounds.coefficients()[c].upper() + rounding) << "coefficient " << c << " at " << q;
  }
}

/// Expects `bounds_on(traits, box)` to enclose values and gradients at points of the box, and to shrink with it.
template <class Model, class Bounds>
void expect_bounds_of_first_order(const Bounds& bounds_on) {
  const auto traits = Model::make();
  std::mt19937 random(2);
  for (const auto& p : Model::points()) {
    std::array<double, 4> last_width;
    last_width.fill(std::numeric_limits<double>::infinity());
    for (double r = Model::length / 2; r > Model::length / 100; r /= 2) {
      const auto bounds = bounds_on(traits, cube(p, r));
      for (int n = 0; n < 50; ++n) {
        const auto q = random_point_in_cube(p, r, random);
        expect_enclosed(equiaffine::first_order(traits, q), bounds, 1e-13, q);
      }
      for (std::size_t c = 0; c < 4; ++c) {
        const double width = bounds.coefficients()[c].upper() - bounds.coefficients()[c].lower();
        EXPECT_LE(width, last_width[c]);
        last_width[c] = width;
      }
    }
    for (const double width : last_width) EXPECT_TRUE(std::isfinite(width));
  }
}

template <class Model>
class Conformance : public ::testing::Test {};

TYPED_TEST_SUITE_P(Conformance);

TYPED_TEST_P(Conformance, value_is_the_constant_coefficient) {
  const auto traits = TypeParam::make();
  for (const auto& p : TypeParam::points()) {
    const double value = traits.value(p);
    ASSERT_TRUE(std::isfinite(value));
    EXPECT_NEAR(traits.taylor(p).value(), value, 1e-13 * (1 + std::abs(value)));
  }
}

// The remainder of an expansion of order 4 shrinks by 2^5 when the distance is halved, until rounding is reached. A
// wrong coefficient of any order would make it shrink by less. A model may say that its derivatives are diffuse, with the
// part of a gradient by which they differ from those of the value at most.
TYPED_TEST_P(Conformance, taylor_is_the_expansion_of_value) {
  const auto traits = TypeParam::make();
  if constexpr (requires { TypeParam::disagreement; }) {
    const double h = TypeParam::length / 100;
    for (const auto& p : TypeParam::points())
      EXPECT_LE(remainder(traits, p, h), TypeParam::disagreement * h / std::abs(traits.value(p)));
    return;
  }
  constexpr double rounding = 1e-13;
  for (const auto& p : TypeParam::points()) {
    double h = TypeParam::length / 4, before = remainder(traits, p, h);
    int halvings = 0;
    for (double after; before > rounding && halvings < 12; before = after, ++halvings) {
      h /= 2;
      after = remainder(traits, p, h);
      if (after > 20 * rounding && halvings > 3) {
        EXPECT_GT(std::log2(before / after), 4.5) << "h = " << h;
      }
    }
    EXPECT_LE(before, rounding) << "the expansion at " << p << " does not converge to the function";
  }
}

TYPED_TEST_P(Conformance, first_order_is_the_beginning_of_taylor) {
  const auto traits = TypeParam::make();
  for (const auto& p : TypeParam::points()) {
    const auto jet = traits.taylor(p);
    const auto linear = equiaffine::first_order(traits, p);
    for (std::size_t n = 0; n < 4; ++n)
      EXPECT_NEAR(linear.coefficients()[n], jet.coefficients()[n], 1e-12 * (1 + std::abs(jet.coefficients()[n])));
  }
}

TYPED_TEST_P(Conformance, the_box_contains_the_points) {
  const auto traits = TypeParam::make();
  const CGAL::Bbox_3 box = traits.bbox();
  for (const auto& p : TypeParam::points()) EXPECT_TRUE(CGAL::do_overlap(box, p.bbox()));
}

TYPED_TEST_P(Conformance, bounds_enclose_the_values_and_shrink_with_the_box) {
  if constexpr (equiaffine::BoundedImplicitFunctionTraits_3<typename TypeParam::Traits>) {
    const auto traits = TypeParam::make();
    std::mt19937 random(1);
    for (const auto& p : TypeParam::points()) {
      double last_width = std::numeric_limits<double>::infinity();
      for (double r = TypeParam::length / 2; r > TypeParam::length / 100; r /= 2) {
        const auto bounds = traits.bounds(cube(p, r));
        for (int n = 0; n < 50; ++n) {
          const auto q = random_point_in_cube(p, r, random);
          const double value = traits.value(q);
          if (std::isfinite(value)) {
            EXPECT_TRUE(bounds.contains(value)) << q;
          }
        }
        EXPECT_LE(bounds.upper() - bounds.lower(), last_width);
        last_width = bounds.upper() - bounds.lower();
      }
      constexpr bool is_unbounded = requires { TypeParam::is_unbounded; };
      EXPECT_NE(std::isfinite(last_width), is_unbounded);
    }
  } else {
    GTEST_SKIP() << "the model has no bounds";
  }
}

TYPED_TEST_P(Conformance, bounds_of_first_order_enclose_value_and_gradient_and_shrink_with_the_box) {
  if constexpr (equiaffine::FirstOrderBoundedImplicitFunctionTraits_3<typename TypeParam::Traits>) {
    expect_bounds_of_first_order<TypeParam>(
        [](const auto& traits, const CGAL::Bbox_3& box) { return traits.first_order_bounds(box); });
  } else {
    GTEST_SKIP() << "the model has no bounds of its gradient";
  }
}

TYPED_TEST_P(Conformance, tight_bounds_of_first_order_are_such_and_inside_the_usual_ones) {
  if constexpr (equiaffine::FirstOrderBoundedImplicitFunctionTraits_3<typename TypeParam::Traits>) {
    expect_bounds_of_first_order<TypeParam>([](const auto& traits, const CGAL::Bbox_3& box) {
      const auto tight = equiaffine::internal::tight_first_order_bounds(traits, box);
      const auto usual = traits.first_order_bounds(box);
      for (std::size_t c = 0; c < 4; ++c) {
        EXPECT_GE(tight.coefficients()[c].lower(), usual.coefficients()[c].lower());
        EXPECT_LE(tight.coefficients()[c].upper(), usual.coefficients()[c].upper());
      }
      return tight;
    });
  } else {
    GTEST_SKIP() << "the model has no bounds of its gradient";
  }
}

TYPED_TEST_P(Conformance, bounds_of_second_order_enclose_the_expansion) {
  if constexpr (equiaffine::SecondOrderBoundedImplicitFunctionTraits_3<typename TypeParam::Traits>) {
    const auto traits = TypeParam::make();
    std::mt19937 random(1);
    for (const auto& p : TypeParam::points()) {
      const double r = TypeParam::length / 8;
      const auto bounds = traits.second_order_bounds(cube(p, r));
      for (int n = 0; n < 20; ++n) {
        const auto q = random_point_in_cube(p, r, random);
        expect_enclosed(traits.taylor(q), bounds, 1e-12, q);
      }
    }
  } else {
    GTEST_SKIP() << "the model has no bounds of its second derivatives";
  }
}

TYPED_TEST_P(Conformance, batches_are_single_calls_bit_for_bit) {
  const equiaffine::Batch_function_traits_3 traits(TypeParam::make());
  const auto points = TypeParam::points();
  std::vector<double> values(points.size());
  std::vector<Jet_3<double>> jets(points.size());
  std::vector<Jet_3<double, 1>> first_orders(points.size());
  traits.values(points, values);
  traits.taylors(points, jets);
  traits.first_orders(points, first_orders);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(same_bits(values[i], double(traits.value(points[i]))));
    EXPECT_TRUE(same_bits(jets[i], traits.taylor(points[i])));
    if (!compiler_contracts()) {
      EXPECT_TRUE(same_bits(first_orders[i], equiaffine::first_order(traits, points[i])));
    }
  }
}

TYPED_TEST_P(Conformance, several_threads_get_the_numbers_of_one) {
  const auto traits = TypeParam::make();
  const auto points = TypeParam::points();
  std::vector<Jet_3<double>> expected;
  for (const auto& p : points) expected.push_back(traits.taylor(p));
  std::array<int, 4> differences{};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < differences.size(); ++t)
    threads.emplace_back([&, t] {
      for (int repeat = 0; repeat < 50; ++repeat)
        for (std::size_t i = 0; i < points.size(); ++i)
          differences[t] += !same_bits(traits.taylor(points[i]), expected[i]) ||
                            !same_bits(double(traits.value(points[i])), double(traits.value(points[i])));
    });
  for (auto& thread : threads) thread.join();
  for (int n : differences) EXPECT_EQ(n, 0);
}

TYPED_TEST_P(Conformance, copies_own_their_data) {
  std::vector<double> expected;
  const auto points = TypeParam::points();
  const auto copy = [&] {
    const auto original = TypeParam::make();
    for (const auto& p : points) expected.push_back(original.value(p));
    return typename TypeParam::Traits(original);
  }();
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_TRUE(same_bits(double(copy.value(points[i])), expected[i]));
}

REGISTER_TYPED_TEST_SUITE_P(Conformance, value_is_the_constant_coefficient, taylor_is_the_expansion_of_value,
                            first_order_is_the_beginning_of_taylor, the_box_contains_the_points,
                            bounds_enclose_the_values_and_shrink_with_the_box,
                            bounds_of_first_order_enclose_value_and_gradient_and_shrink_with_the_box,
                            tight_bounds_of_first_order_are_such_and_inside_the_usual_ones,
                            bounds_of_second_order_enclose_the_expansion, batches_are_single_calls_bit_for_bit,
                            several_threads_get_the_numbers_of_one, copies_own_their_data);

} // namespace conformance

#endif
