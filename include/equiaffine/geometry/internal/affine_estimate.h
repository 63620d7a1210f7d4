// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_AFFINE_ESTIMATE_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_AFFINE_ESTIMATE_H

#include <equiaffine/number/Jet_3.h>

#include <array>
#include <cstddef>

namespace equiaffine {

/// The quantities that the paper estimates, in the conventions of Affine_structure_3.
template <class FT>
struct Affine_estimate_3 {
  std::array<FT, 3> conormal, ///< nu
      normal;                 ///< xi
  FT gaussian_curvature,      ///< K
      mean_curvature;         ///< H
};

namespace internal {

/// The partial derivatives of f in the order of the monomials.
template <class FT>
std::array<FT, Jet_3<FT>::size> partial_derivatives(const Jet_3<FT>& jet) {
  constexpr std::array<int, 5> factorial = {1, 1, 2, 6, 24};
  std::array<FT, Jet_3<FT>::size> f;
  for (std::size_t n = 0; n < f.size(); ++n) {
    const Monomial_3 m = monomials[n];
    f[n] = jet.coefficients()[n] *
           FT(factorial[std::size_t(m.i)] * factorial[std::size_t(m.j)] * factorial[std::size_t(m.k)]);
  }
  return f;
}

} // namespace internal

} // namespace equiaffine

#endif
