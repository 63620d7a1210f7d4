// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_FIRST_ORDER_BOUNDS_H
#define EQUIAFFINE_FUNCTION_INTERNAL_FIRST_ORDER_BOUNDS_H

#include <equiaffine/function/concepts.h>

#include <array>
#include <cstddef>

namespace equiaffine::internal {

/// What a model knows about its values and gradients on a box; the whole line where it knows nothing.
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

/// A box less its center, along the axes.
inline std::array<Interval, 3> offset_from_center(const CGAL::Bbox_3& box, const std::array<double, 3>& center) {
  std::array<Interval, 3> offset;
  for (int a = 0; a < 3; ++a) {
    const auto n = std::size_t(a);
    offset[n] = Interval(box.min(a), box.max(a)) - Interval(center[n]);
  }
  return offset;
}

inline std::array<double, 3> center_of(const CGAL::Bbox_3& box) {
  return {(box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2};
}

inline CGAL::Bbox_3 box_of_point(const std::array<double, 3>& p) {
  return CGAL::Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
}

/// Bounds on a box from those of second order and the expansion at a point, where `offset` is the box less the point,
/// in mean value form.
inline Jet_3<Interval, 1> mean_value_bounds(const Jet_3<Interval, 2>& jet, const Jet_3<Interval, 1>& start,
                                            const std::array<Interval, 3>& offset) {
  std::array<Interval, 4> sum = start.coefficients();
  for (std::size_t a = 0; a < 3; ++a) {
    sum[0] += jet.coefficients()[1 + a] * offset[a];
    for (std::size_t b = 0; b < 3; ++b) {
      std::array<int, 3> exponents = {};
      ++exponents[a], ++exponents[b];
      const int n = monomial_index(exponents[0], exponents[1], exponents[2]);
      sum[1 + a] += jet.coefficients()[std::size_t(n)] * offset[b] * Interval(a == b ? 2 : 1);
    }
  }
  Jet_3<Interval, 1> bounds;
  for (std::size_t n = 0; n < 4; ++n) bounds.coefficients()[n] = Interval::intersection(jet.coefficients()[n], sum[n]);
  return bounds;
}

/// The tightest that it knows. With bounds of second order, at about three times the cost, the excess over the range
/// shrinks with the square of the box.
template <ImplicitFunctionTraits_3 Traits>
Jet_3<Interval, 1> tight_first_order_bounds(const Traits& traits, const CGAL::Bbox_3& box) {
  if constexpr (requires { traits.mean_value_bounds(box); }) {
    return traits.mean_value_bounds(box);
  } else if constexpr (SecondOrderBoundedImplicitFunctionTraits_3<Traits>) {
    const auto center = center_of(box);
    const auto start = traits.first_order_bounds(box_of_point(center));
    return mean_value_bounds(traits.second_order_bounds(box), start, offset_from_center(box, center));
  } else {
    return first_order_bounds(traits, box);
  }
}

/// What a function knows of itself in boxes.
struct Known_bounds {
  bool have_gradients, are_tight_in_small_boxes;
};

/// A model that learns it at run time has a member.
template <ImplicitFunctionTraits_3 Traits>
Known_bounds known_bounds(const Traits& traits) {
  if constexpr (requires { traits.known_bounds(); }) return traits.known_bounds();
  else return {FirstOrderBoundedImplicitFunctionTraits_3<Traits>, SecondOrderBoundedImplicitFunctionTraits_3<Traits>};
}

} // namespace equiaffine::internal

#endif
