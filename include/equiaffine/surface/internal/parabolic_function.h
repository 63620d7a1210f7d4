// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_PARABOLIC_FUNCTION_H
#define EQUIAFFINE_SURFACE_INTERNAL_PARABOLIC_FUNCTION_H

#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/monomials_3.h>

#include <cstddef>

namespace equiaffine {

/// K_e |grad f|^4, a polynomial in the derivatives of f of order 1 and 2 (Goldman: Curvature formulas for implicit
/// curves and surfaces, 2005), with its derivatives up to order 1 or 2. \pre the jet is finite.
template <int Order = 1, class FT>
requires(Order >= 1 && Order <= 2) Jet_3<FT, Order> parabolic_function(const Jet_3<FT>& f) {
  const auto derivative = [&](int i, int j, int k) {
    Jet_3<FT, Order> jet;
    for (std::size_t n = 0; n < jet.size; ++n) {
      const auto& m = internal::monomials[n];
      const int factorials = (m.i == 2 || m.j == 2 || m.k == 2) ? 2 : 1;
      jet.coefficients()[n] = f.derivative(i + m.i, j + m.j, k + m.k) / FT(factorials);
    }
    return jet;
  };
  const auto x = derivative(1, 0, 0), y = derivative(0, 1, 0), z = derivative(0, 0, 1);
  const auto xx = derivative(2, 0, 0), yy = derivative(0, 2, 0), zz = derivative(0, 0, 2);
  const auto xy = derivative(1, 1, 0), xz = derivative(1, 0, 1), yz = derivative(0, 1, 1);
  return (yy * zz - yz * yz) * x * x + (xx * zz - xz * xz) * y * y + (xx * yy - xy * xy) * z * z +
         FT(2) * ((xz * xy - xx * yz) * y * z + (xy * yz - yy * xz) * x * z + (yz * xz - zz * xy) * x * y);
}

} // namespace equiaffine

#endif
