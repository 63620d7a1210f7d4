// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_ROOT_OF_SQUARES_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_ROOT_OF_SQUARES_H

#include <equiaffine/number/select.h>

#include <cmath>

namespace equiaffine::internal {

/// sqrt(x^2 + y^2) for numbers and packs; the squares neither overflow nor underflow.
template <class FT>
FT root_of_squares(const FT& x, const FT& y) {
  using std::abs;
  using std::sqrt;
  const FT u = abs(x), v = abs(y), large = select(u > v, u, v), small = select(u > v, v, u);
  const FT ratio = select(large == FT(0), FT(0), FT(small / large));
  return large * sqrt(FT(FT(1) + ratio * ratio));
}

} // namespace equiaffine::internal

#endif
