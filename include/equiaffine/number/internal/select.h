// SPDX-License-Identifier: GPL-3.0-or-later
// The few words in which a formula chooses without branching, so that it can be read for one number and for a pack of
// numbers. Pack.h has the overloads for packs, found by argument-dependent lookup.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_SELECT_H
#define EQUIAFFINE_NUMBER_INTERNAL_SELECT_H

#include <cmath>
#include <limits>
#include <utility>

namespace equiaffine::internal {

/// What a comparison of two numbers yields: bool, or one truth value per lane.
template <class FT>
using Mask_of = decltype(std::declval<const FT&>() < std::declval<const FT&>());

template <class FT>
FT select(bool condition, const FT& yes, const FT& no) {
  return condition ? yes : no;
}

/// Neither infinite nor NaN, without an arithmetic operation.
template <class FT>
Mask_of<FT> is_finite_number(const FT& x) {
  using std::abs;
  return abs(x) <= FT(std::numeric_limits<FT>::max());
}

/// For numbers of the processor, up to double, and packs of them.
template <class FT>
inline constexpr bool is_built_in =
    std::numeric_limits<FT>::is_iec559&& std::numeric_limits<FT>::digits <= std::numeric_limits<double>::digits;

/// P / Q, for built-in numbers and packs of them divided by the compiler, which under -frounding-math (CGAL sets it)
/// would leave that to every call.
template <int P, int Q, class FT>
FT fraction() {
  if constexpr (is_built_in<FT>) {
    constexpr double quotient = double(P) / Q;
    return FT(quotient);
  } else {
    return FT(P) / FT(Q);
  }
}

} // namespace equiaffine::internal

#endif
