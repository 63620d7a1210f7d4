// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_FIRST_ORDER_BOUNDS_H
#define EQUIAFFINE_FUNCTION_INTERNAL_FIRST_ORDER_BOUNDS_H

#include <equiaffine/function/concepts.h>
#include <equiaffine/function/internal/box_intervals.h>

#include <array>
#include <cstddef>

namespace equiaffine::internal {

/// Bounds of value and gradient on a box. Where the model has none, they are the whole line.
template <ImplicitFunctionTraits_3 Traits>
Jet_3<Interval, 1> first_order_bounds(const Traits& traits, const CGAL::Bbox_3& box) {
  if constexpr (FirstOrderBoundedImplicitFunctionTraits_3<Traits>) {
    return traits.first_order_bounds(box);
  } else {
    Jet_3<Interval, 1> jet;
    jet.coefficients().fill(Interval::whole());
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>) jet.at<0>() = traits.bounds(box);
    return jet;
  }
}

/// The index of the monomial that is the product of two coordinates.
inline std::size_t index_of_product(std::size_t axis, std::size_t other_axis) {
  std::array<int, 3> exponents = {};
  ++exponents[axis];
  ++exponents[other_axis];
  return std::size_t(monomial_index(exponents[0], exponents[1], exponents[2]));
}

/// Bounds of value and gradient on a box by the mean value theorem: f lies in f(c) + sum of f_a offset_a, and its
/// derivative f_a along axis a lies in f_a(c) + sum of f_ab offset_b. Here c is a point of the box, `at_point` has the
/// bounds at c, `on_box` has the bounds on the box, and `offset` the vectors from c to the points of the box. The
/// result is the intersection of these bounds with those in `on_box`.
inline Jet_3<Interval, 1> mean_value_bounds(const Jet_3<Interval, 2>& on_box, const Jet_3<Interval, 1>& at_point,
                                            const std::array<Interval, 3>& offset) {
  const auto& derivatives = on_box.coefficients();
  std::array<Interval, 4> sum = at_point.coefficients();
  for (std::size_t a = 0; a < 3; ++a) {
    sum[0] += derivatives[1 + a] * offset[a];
    for (std::size_t b = 0; b < 3; ++b) // the Taylor coefficient of x_a^2 is half of f_aa
      sum[1 + a] += derivatives[index_of_product(a, b)] * offset[b] * Interval(a == b ? 2 : 1);
  }
  Jet_3<Interval, 1> bounds;
  for (std::size_t n = 0; n < 4; ++n) bounds.coefficients()[n] = Interval::intersection(derivatives[n], sum[n]);
  return bounds;
}

/// The tightest bounds of value and gradient that the model can give. Those from bounds of second order cost about
/// three times as much, and exceed the range by a multiple of the square of the box's size only.
template <ImplicitFunctionTraits_3 Traits>
Jet_3<Interval, 1> tight_first_order_bounds(const Traits& traits, const CGAL::Bbox_3& box) {
  if constexpr (requires { traits.mean_value_bounds(box); }) {
    return traits.mean_value_bounds(box);
  } else if constexpr (SecondOrderBoundedImplicitFunctionTraits_3<Traits>) {
    const auto center = center_of(box);
    const auto at_center = traits.first_order_bounds(box_of_point(center));
    return mean_value_bounds(traits.second_order_bounds(box), at_center, offset_from_center(box, center));
  } else {
    return first_order_bounds(traits, box);
  }
}

/// Which bounds a model has. They are tight in small boxes if their excess over the range shrinks with the square of
/// the box's size.
struct Known_bounds {
  bool have_gradients, are_tight_in_small_boxes;
};

/// A model that learns at run time which bounds it has says so in a member.
template <ImplicitFunctionTraits_3 Traits>
Known_bounds known_bounds(const Traits& traits) {
  if constexpr (requires { traits.known_bounds(); }) return traits.known_bounds();
  else return {FirstOrderBoundedImplicitFunctionTraits_3<Traits>, SecondOrderBoundedImplicitFunctionTraits_3<Traits>};
}

} // namespace equiaffine::internal

#endif
