// SPDX-License-Identifier: GPL-3.0-or-later
// Choices without branches, so that one formula serves a number and a pack of numbers. Argument-dependent lookup finds
// the overloads of Pack.h.
#ifndef EQUIAFFINE_NUMBER_SELECT_H
#define EQUIAFFINE_NUMBER_SELECT_H

#include <cmath>
#include <limits>
#include <utility>

namespace equiaffine {

/// The type of the result of comparing two numbers: bool, or one truth value per lane.
template <class FT>
using Mask_of = decltype(std::declval<const FT&>() < std::declval<const FT&>());

/// Returns `yes` or `no`. Packs have an overload that does so in each lane.
template <class FT>
FT select(bool condition, const FT& yes, const FT& no) {
  return condition ? yes : no;
}

/// Whether the condition holds; for packs, in any lane.
inline bool any(bool condition) { return condition; }

/// Whether x is neither infinite nor NaN, decided without an arithmetic operation.
template <class FT>
Mask_of<FT> is_finite_number(const FT& x) {
  using std::abs;
  return abs(x) <= FT(std::numeric_limits<FT>::max());
}

/// Whether FT is a number of the processor, up to double, or a pack of such numbers.
template <class FT>
inline constexpr bool is_built_in =
    std::numeric_limits<FT>::is_iec559&& std::numeric_limits<FT>::digits <= std::numeric_limits<double>::digits;

/// P / Q. For built-in numbers and packs of them the compiler divides, which under -frounding-math (CGAL sets it) it
/// would leave to every call.
template <int P, int Q, class FT>
FT fraction() {
  if constexpr (is_built_in<FT>) {
    constexpr double quotient = double(P) / Q;
    return FT(quotient);
  } else {
    return FT(P) / FT(Q);
  }
}

} // namespace equiaffine

#endif
