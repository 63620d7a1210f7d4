// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives where functions have kinks and jumps. Interval_functions.h has overloads for ranges that may contain
// some, found by argument-dependent lookup.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_NONSMOOTH_H
#define EQUIAFFINE_NUMBER_INTERNAL_NONSMOOTH_H

#include <limits>

namespace equiaffine::internal {

/// The coefficient of max(u, v), NaN exactly at the kink, when u has `a` and v has `b`, for a monomial of the given
/// degree.
template <class T>
T branch_or_kink(const T& u, const T& v, const T& a, const T& b, int degree) {
  return u > v ? a : v > u ? b : degree == 0 ? (u == v ? a : T(u + v)) : std::numeric_limits<T>::quiet_NaN();
}

/// What the derivatives of atan2(y, x) are multiplied by for its jump along the negative x-axis: a point is on one
/// side.
template <class T>
T factor_for_jump(const T&, const T&) {
  return T(1);
}

} // namespace equiaffine::internal

#endif
