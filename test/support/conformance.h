// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the semantic requirements of ImplicitFunctionTraits_3. A parameter of the suite is a type with
//   using Traits; static Traits make(); static std::vector<Point_3> points();   // in the box, where f is smooth
//   static constexpr double length;                                             // over which f varies by its own size
//   static constexpr bool is_unbounded = true;   // optional: bounds say where f has no value, and no more
#ifndef EQUIAFFINE_TEST_SUPPORT_CONFORMANCE_H
#define EQUIAFFINE_TEST_SUPPORT_CONFORMANCE_H

#include "support/conformance_checks.h"
#include "support/contraction.h"
#include "support/same_bits.h"
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/Transformed_function_traits_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <thread>
#include <vector>

namespace conformance {

using equiaffine::Jet_3;

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

// The remainder of an expansion of order 4 decreases by 2^5 when the distance is halved, until rounding dominates. With
// a wrong coefficient of any order it decreases by less. A model can declare its derivatives as diffuse, with a bound
// on their relative difference from the derivatives of the value.
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
      const auto tight = equiaffine::tight_first_order_bounds(traits, box);
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

TYPED_TEST_P(Conformance, capabilities_keep_their_promises) {
  using namespace equiaffine;
  const auto traits = TypeParam::make();
  const CGAL::Bbox_3 box = traits.bbox();
  const auto lattice = sampling_lattice(traits, {5, 6, 7});
  EXPECT_EQ(lattice.size(), (std::array<std::size_t, 3>{5, 6, 7}));
  for (int axis = 0; axis < 3; ++axis) {
    const double rounding = 1e-13 * (box.max(axis) - box.min(axis));
    EXPECT_NEAR(lattice.bbox().min(axis), box.min(axis), rounding);
    EXPECT_NEAR(lattice.bbox().max(axis), box.max(axis), rounding);
  }
  for (const auto& p : TypeParam::points()) {
    EXPECT_GE(rounding(traits, p), 0);
    EXPECT_GE(certainty(traits, p), 0);
    EXPECT_LE(certainty(traits, p), 1);
    const auto bounds = first_order_bounds(traits, cube(p, TypeParam::length / 100));
    if (known_bounds(traits).have_gradients) {
      for (const Interval& i : bounds.coefficients()) EXPECT_TRUE(std::isfinite(i.upper() - i.lower()));
    }
  }
}

TYPED_TEST_P(Conformance, zeros_on_segments_are_such) {
  const auto traits = TypeParam::make();
  const auto segment = segment_with_zero<TypeParam>();
  if (!segment) GTEST_SKIP() << "f has one sign at the points of the model";
  const auto& [a, b] = *segment;
  const auto zero = equiaffine::intersect_segment(traits, a, b, traits.value(a), traits.value(b));
  ASSERT_TRUE(zero.has_converged);
  EXPECT_NEAR(traits.value(zero.point), 0, 1e-14);
  EXPECT_LE(CGAL::cross_product(zero.point - a, b - a).squared_length(), 1e-28);
}

TYPED_TEST_P(Conformance, wrappers_have_the_capabilities) {
  using namespace equiaffine;
  using Traits = typename TypeParam::Traits;
  using Kernel = Kernel_of<Traits>;
  const Traits base = TypeParam::make();
  const typename Kernel::Aff_transformation_3 map(2, 0, 0, .5, 0, -.25, .5, 0, 0, 0, 4, 1);
  const Level_set_traits_3 level_set(base, 0.25, Orientation_of_level_set::AGAINST_GRADIENT), same(base, 0);
  const Transformed_function_traits_3 image(base, map), identity(base);
  const Batch_function_traits_3 batch(base);
  const auto any = Any_function_3::make(base);
  static_assert(has_refinements_of<Level_set_traits_3<Traits>, Traits>());
  static_assert(has_refinements_of<Transformed_function_traits_3<Traits>, Traits>());
  for (const auto& p : TypeParam::points()) {
    const CGAL::Bbox_3 box = cube(p, TypeParam::length / 50);
    expect_capabilities_of(level_set, p, base, p);
    expect_capabilities_of(image, map(p), base, p);
    expect_capabilities_of(identity, p, base, p);
    expect_capabilities_of(batch, p, base, p);
    expect_capabilities_of(any, p, base, p);
    const double of_base = rounding(base, p);
    EXPECT_EQ(rounding(level_set, p), of_base);
    EXPECT_EQ(rounding(image, map(p)) > 0, of_base > 0);
    EXPECT_EQ(rounding(any, p), of_base);
    EXPECT_EQ(rounding(identity, p), of_base);
    const auto tight = tight_first_order_bounds(base, box);
    auto reversed = tight_first_order_bounds(level_set, box);
    reversed.template at<0>() = reversed.value() - Interval(0.25);
    for (Interval& i : reversed.coefficients()) i = -i;
    expect_equal_bounds(reversed, tight);
    expect_equal_bounds(tight_first_order_bounds(same, box), tight);
    expect_equal_bounds(tight_first_order_bounds(any, box), tight);
    expect_equal_bounds(first_order_bounds(any, box), first_order_bounds(base, box));
    EXPECT_TRUE(same_bits(tight_first_order_bounds(identity, box), tight));
    for (const auto& jet : {any.taylor(p), identity.taylor(p)}) EXPECT_TRUE(same_bits(jet, base.taylor(p)));
  }
  const auto lattice = sampling_lattice(base, {5, 6, 7});
  for (const auto& copy : {sampling_lattice(level_set, {5, 6, 7}), sampling_lattice(identity, {5, 6, 7}),
                           sampling_lattice(batch, {5, 6, 7}), sampling_lattice(any, {5, 6, 7})}) {
    EXPECT_EQ(copy.origin(), lattice.origin());
    EXPECT_EQ(copy.steps(), lattice.steps());
  }
  expect_same_numbers<TypeParam>(identity);
  expect_same_numbers<TypeParam>(any);
  const auto segment = segment_with_zero<TypeParam>();
  if (!segment) return;
  const auto& [a, b] = *segment;
  const auto zero_of = [&](const auto& function, const auto& from, const auto& to) {
    return intersect_segment(function, from, to, base.value(a), base.value(b));
  };
  const auto zero = zero_of(base, a, b);
  for (const auto& found : {zero_of(same, a, b), zero_of(identity, a, b), zero_of(batch, a, b), zero_of(any, a, b)}) {
    EXPECT_EQ(found.point, zero.point);
    EXPECT_EQ(found.evaluations, zero.evaluations);
  }
  const auto moved = zero_of(image, map(a), map(b));
  EXPECT_LE((moved.point - map(zero.point)).squared_length(), 1e-28);
  EXPECT_NEAR(double(moved.evaluations), double(zero.evaluations), 2);
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
        for (std::size_t i = 0; i < points.size(); ++i) {
          const typename TypeParam::Traits copy(traits);
          differences[t] += !same_bits(copy.taylor(points[i]), expected[i]) ||
                            !same_bits(double(traits.value(points[i])), double(copy.value(points[i])));
          if constexpr (equiaffine::RestrictableImplicitFunctionTraits_3<typename TypeParam::Traits>)
            if (const auto part = traits.restricted(cube(points[i], TypeParam::length / 10)))
              differences[t] += !same_bits(double(part->value(points[i])), double(traits.value(points[i])));
        }
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
                            bounds_of_second_order_enclose_the_expansion, capabilities_keep_their_promises,
                            zeros_on_segments_are_such, wrappers_have_the_capabilities,
                            batches_are_single_calls_bit_for_bit, several_threads_get_the_numbers_of_one,
                            copies_own_their_data);

} // namespace conformance

#endif
