// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_VALUE_H
#define EQUIAFFINE_VOLUME_INTERNAL_BSPLINE_VALUE_H

#include <equiaffine/volume/internal/bspline.h>

#include <cmath>
#include <cstddef>

namespace equiaffine {

/// The centered cardinal B-spline of odd degree n <= 9 at t. Its knots are the integers from -(n + 1) / 2 to
/// (n + 1) / 2, beyond which it is 0; its shifts by integers sum to 1. It is evaluated by the polynomials on cells of
/// which the splines of this library are made.
template <int Degree, class FT>
FT bspline(FT t) {
  static constexpr auto basis = internal::bspline_basis_polynomials<FT, Degree, Degree + 1>();
  const int cell = int(std::floor(t)), r = internal::spline_padding(Degree) - cell;
  if (r < 0 || r > Degree) return 0;
  FT value = 0;
  for (int p = Degree; p >= 0; --p) value = value * (t - FT(cell) - FT(0.5)) + basis[std::size_t(p)][std::size_t(r)];
  return value;
}

} // namespace equiaffine

#endif
