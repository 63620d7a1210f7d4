// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_ROUNDING_H
#define EQUIAFFINE_FUNCTION_INTERNAL_ROUNDING_H

#include <equiaffine/function/concepts.h>

namespace equiaffine::internal {

template <class Traits>
concept Has_rounding = requires(const Traits& traits, const typename Traits::Point_3& p) {
  traits.rounding(p);
};

/// How large errors of second derivatives at p can be, beyond some roundings of their own size: what the optional
/// member `rounding(p)` of a model says, else 0. A K_e that they could produce counts as zero.
template <ImplicitFunctionTraits_3 Traits>
typename Traits::FT rounding(const Traits& traits, const typename Traits::Point_3& p) {
  if constexpr (Has_rounding<Traits>) return traits.rounding(p);
  else return typename Traits::FT(0);
}

} // namespace equiaffine::internal

#endif
