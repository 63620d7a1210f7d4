// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_AFFINE_GRADIENTS_H
#define EQUIAFFINE_GEOMETRY_AFFINE_GRADIENTS_H

#include <equiaffine/function/concepts.h>
#include <equiaffine/geometry/internal/gradient_norms.h>

#include <array>

namespace equiaffine {

/// Computes the norms of the gradients of K, H and J on the surface in the affine metric, in this order. Together with
/// K, H and J they are the signature of the surface at p, which affine maps of determinant 1 keep. A norm is the root
/// of the absolute value of |K_e|^(1/4) (a^2 / k1 + b^2 / k2), where a and b are the derivatives along the principal
/// directions. On hyperbolic surfaces the metric is indefinite, and the norm is 0 for gradients along an asymptotic
/// direction, too. Units: length^(-15/4), length^(-9/4), length^(-9/4).
///
/// These are derivatives of order 5, while expansions have order 4. So they are computed from differences of invariants
/// of neighboring level sets, with some 9 digits where the invariants change slowly over a tenth of the smaller radius
/// of curvature. They are NaN if p is not regular, or if no neighborhood of p is, as on the border of a volume. Takes
/// up to 40 expansions.
template <ImplicitFunctionTraits_3 Traits>
std::array<typename Traits::FT, 3> affine_gradient_norms(const Traits& traits, const typename Traits::Point_3& p) {
  return internal::affine_gradient_norms_at(traits, p);
}

} // namespace equiaffine

#endif
