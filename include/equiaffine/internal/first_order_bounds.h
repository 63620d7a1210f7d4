// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_FIRST_ORDER_BOUNDS_H
#define EQUIAFFINE_INTERNAL_FIRST_ORDER_BOUNDS_H

#include <equiaffine/concepts.h>

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

/// The tightest that it knows, at a higher cost.
template <ImplicitFunctionTraits_3 Traits>
Jet_3<Interval, 1> tight_first_order_bounds(const Traits& traits, const CGAL::Bbox_3& box) {
  if constexpr (requires { traits.mean_value_bounds(box); }) return traits.mean_value_bounds(box);
  else return first_order_bounds(traits, box);
}

/// Whether it knows something of the gradients. A model that learns this at run time has a member.
template <ImplicitFunctionTraits_3 Traits>
bool has_gradient_bounds(const Traits& traits) {
  if constexpr (requires { traits.has_gradient_bounds(); }) return traits.has_gradient_bounds();
  else return FirstOrderBoundedImplicitFunctionTraits_3<Traits>;
}

} // namespace equiaffine::internal

#endif
