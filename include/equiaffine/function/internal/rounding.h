// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_ROUNDING_H
#define EQUIAFFINE_FUNCTION_INTERNAL_ROUNDING_H

#include <equiaffine/function/concepts.h>

namespace equiaffine::internal {

/// A model whose second derivatives have errors beyond roundings of their own size, such as those of a spline.
template <class Traits>
concept Has_rounding = requires(const Traits& traits, const typename Traits::Point_3& p) {
  traits.rounding(p);
};

/// How large errors of second derivatives at p can be, beyond some roundings of their own size. The optional member
/// `rounding(p)` of a model tells; without it there are none. A Gaussian curvature that such errors could produce
/// counts as zero.
template <ImplicitFunctionTraits_3 Traits>
typename Traits::FT rounding(const Traits& traits, const typename Traits::Point_3& p) {
  if constexpr (Has_rounding<Traits>) return traits.rounding(p);
  else return typename Traits::FT(0);
}

} // namespace equiaffine::internal

#endif
