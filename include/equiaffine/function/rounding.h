// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_ROUNDING_H
#define EQUIAFFINE_FUNCTION_ROUNDING_H

#include <equiaffine/function/concepts.h>

namespace equiaffine {

/// A model that tells how large the errors of its second derivatives are, because these are larger than roundings of
/// the derivatives, as for a spline.
template <class Traits>
concept Has_rounding = requires(const Traits& traits, const typename Traits::Point_3& p) {
  traits.rounding(p);
};

/// The greatest error of second derivatives at p, apart from some roundings of the derivatives: what the optional
/// member `rounding(p)` of the model returns, or 0 if the model has no such member. A Gaussian curvature that such
/// errors could produce counts as zero.
template <ImplicitFunctionTraits_3 Traits>
typename Traits::FT rounding(const Traits& traits, const typename Traits::Point_3& p) {
  if constexpr (Has_rounding<Traits>) return traits.rounding(p);
  else return typename Traits::FT(0);
}

} // namespace equiaffine

#endif
