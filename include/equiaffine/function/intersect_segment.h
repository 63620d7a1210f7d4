// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERSECT_SEGMENT_H
#define EQUIAFFINE_FUNCTION_INTERSECT_SEGMENT_H

#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/function/internal/bracketed_roots.h>

namespace equiaffine {

/// Finds a zero of f on the segment ab, at whose ends f has the values fa and fb of different signs (0 counts as
/// positive). This is done by Newton's method if the model has derivatives that cost less than `taylor`, else by
/// Chandrupatla's method. Both start from linear interpolation and stay within the bracket. The result is accurate to a
/// few roundings of the coordinates. If |f| neither gets smaller than at both ends nor negligible, the sign changes
/// without a zero, at a pole, a jump or a place where f ceases to be defined, and the result has not converged and says
/// which it is. If the model has a member of this name, that member is called instead.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> intersect_segment(const Traits& traits, const typename Traits::Point_3& a,
                                                     const typename Traits::Point_3& b, const typename Traits::FT& fa,
                                                     const typename Traits::FT& fb) {
  if constexpr (requires { traits.intersect_segment(a, b, fa, fb); }) {
    return traits.intersect_segment(a, b, fa, fb);
  } else {
    const internal::Bracket_3<Kernel_of<Traits>> bracket(a, b, fa, fb);
    auto result = [&] {
      if constexpr (FirstOrderImplicitFunctionTraits_3<Traits>) {
        internal::Newton_search_3 search(bracket);
        while (!search.has_ended()) search.advance(traits, first_order(traits, search.point()));
        return search.result();
      } else {
        return internal::chandrupatla(traits, bracket);
      }
    }();
    internal::explain(traits, bracket, result);
    return result;
  }
}

} // namespace equiaffine

#endif
