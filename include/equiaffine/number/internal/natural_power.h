// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_NUMBER_INTERNAL_NATURAL_POWER_H
#define EQUIAFFINE_NUMBER_INTERNAL_NATURAL_POWER_H

#include <cmath>
#include <type_traits>

namespace equiaffine::internal {

/// x^n by repeated squaring, which loses up to n / 2 units in the last place, unless the C library does better.
template <class T>
T natural_power(T x, unsigned n) {
  if constexpr (std::is_floating_point_v<T>)
    if (n > 8) return std::pow(x, T(n));
  T r(1);
  for (bool first = true; n > 0; n >>= 1) {
    if (n & 1) {
      r = first ? x : r * x;
      first = false;
    }
    if (n > 1) x = x * x;
  }
  return r;
}

} // namespace equiaffine::internal

#endif
