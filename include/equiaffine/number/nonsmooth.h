// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives where functions have kinks and jumps. Argument-dependent lookup finds the overloads of interval.h, whose
// ranges may contain kinks and jumps, and those of Pack.h.
#ifndef EQUIAFFINE_NUMBER_NONSMOOTH_H
#define EQUIAFFINE_NUMBER_NONSMOOTH_H

#include <equiaffine/number/select.h>

#include <limits>

namespace equiaffine {

/// The coefficient of a monomial of the given degree in the jet of max(u, v), where the jets of u and v have the
/// coefficients `a` and `b`. At the kink, where u = v, the coefficient of degree 0 is right and the others are NaN.
template <class T>
T branch_or_kink(const T& u, const T& v, const T& a, const T& b, int degree) {
  return u > v ? a : v > u ? b : degree == 0 ? (u == v ? a : T(u + v)) : std::numeric_limits<T>::quiet_NaN();
}

/// The factor by which the derivatives of atan2(y, x) are multiplied because of its jump along the negative x-axis. For
/// numbers it is 1, since a point lies on one side of the jump.
template <class T>
T factor_for_jump(const T&, const T&) {
  return T(1);
}

/// What the derivatives of fmod(a, b) get added to them, where r is its value: 0, or NaN where it jumps. Found by
/// argument-dependent lookup for intervals, whose numbers may have a jump among them.
template <class T>
T jump_of_remainder(const T& a, const T&, const T& r) {
  return select(r == T(0) && a != T(0), T(std::numeric_limits<T>::quiet_NaN()), T(0));
}

} // namespace equiaffine

#endif
