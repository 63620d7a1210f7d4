// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERSECT_SEGMENT_H
#define EQUIAFFINE_SURFACE_INTERSECT_SEGMENT_H

#include <equiaffine/function/concepts.h>
#include <equiaffine/surface/Surface_point_3.h>
#include <equiaffine/surface/internal/bracketed_roots.h>

namespace equiaffine {

/// A zero of f on the segment ab, at whose ends f has the values fa and fb of different signs (0 counts as positive):
/// by Newton's method where the model has derivatives that cost less than `taylor`, else by Chandrupatla's, both from
/// the linear interpolation and kept within the bracket. The result is accurate to a few roundings of the coordinates.
/// A sign change without a zero, at a pole or a jump, is told by |f| getting neither smaller than at both ends nor
/// negligible: not converged. A model with a member of this name is asked instead.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> intersect_segment(const Traits& traits, const typename Traits::Point_3& a,
                                                     const typename Traits::Point_3& b, const typename Traits::FT& fa,
                                                     const typename Traits::FT& fb) {
  if constexpr (requires { traits.intersect_segment(a, b, fa, fb); }) {
    return traits.intersect_segment(a, b, fa, fb);
  } else {
    const internal::Bracket_3<Kernel_of<Traits>> bracket(a, b, fa, fb);
    if constexpr (FirstOrderImplicitFunctionTraits_3<Traits>) return internal::newton(traits, bracket);
    else return internal::chandrupatla(traits, bracket);
  }
}

} // namespace equiaffine

#endif
