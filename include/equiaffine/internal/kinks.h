// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of max(u, v) for an ordered number type: NaN exactly at the kink. Interval.h has an overload for ranges
// that may contain a kink, found by argument-dependent lookup.
#ifndef EQUIAFFINE_INTERNAL_KINKS_H
#define EQUIAFFINE_INTERNAL_KINKS_H

#include <limits>

namespace equiaffine::internal {

/// The coefficient of max(u, v) when u has `a` and v has `b`, for a monomial of the given degree.
template <class T>
T branch_or_kink(const T& u, const T& v, const T& a, const T& b, int degree) {
  return u > v ? a : v > u ? b : degree == 0 ? (u == v ? a : T(u + v)) : std::numeric_limits<T>::quiet_NaN();
}

} // namespace equiaffine::internal

#endif
