// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_AFFINE_GRADIENTS_H
#define EQUIAFFINE_SURFACE_INTERNAL_AFFINE_GRADIENTS_H

#include <equiaffine/function/concepts.h>
#include <equiaffine/surface/internal/gradients_of_invariants.h>

#include <array>

namespace equiaffine {

/// Computes the norms of the gradients of K, H and J on the surface in the affine metric, in this order. Together with
/// K, H and J they are the signature of the surface at p, which affine maps of determinant 1 keep. A norm is the root
/// of the absolute value of |K_e|^(1/4) (a^2 / k1 + b^2 / k2), where a and b are the derivatives along the principal
/// directions. On hyperbolic surfaces the metric is indefinite, and the norm is 0 for gradients along an asymptotic
/// direction, too. Units: length^(-15/4), length^(-9/4), length^(-9/4).
///
/// These are derivatives of order 5: those of the function if it has \ref fifth_order(), else differences of invariants
/// of neighboring level sets, which take 40 expansions and are NaN where they are not known to a hundredth. All are NaN
/// where p is not regular.
template <ImplicitFunctionTraits_3 Traits>
std::array<typename Traits::FT, 3> affine_gradient_norms(const Traits& traits, const typename Traits::Point_3& p) {
  return internal::gradient_norms_of(internal::differentiated_structure(traits, p));
}

/// The gradients of K, H and J on the surface at a point, each as the derivatives along the vectors e1 and e2 of its
/// affine_frame(). With a the determinant of a map they have the weights a^(-5/4), a^(-3/4) and a^(-3/4); the norms of
/// affine_gradient_norms() are the roots of a^2 + b^2 at an elliptic point and of |2 a b| at a hyperbolic one.
template <class FT>
struct Affine_gradients_3 {
  std::array<FT, 2> gaussian_curvature, mean_curvature, pick_invariant;
};

/// Computes the gradients as affine_gradient_norms() does. They are those for the side that the gradient of f points
/// to, and NaN where the frame does not exist.
template <ImplicitFunctionTraits_3 Traits>
Affine_gradients_3<typename Traits::FT> affine_gradients(const Traits& traits, const typename Traits::Point_3& p) {
  const auto gradients = internal::gradients_in_frame(internal::differentiated_structure(traits, p));
  return {gradients[0], gradients[1], gradients[2]};
}

} // namespace equiaffine

#endif
