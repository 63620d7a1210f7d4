// SPDX-License-Identifier: GPL-3.0-or-later
// Choices without branches, so that one formula serves a number and a pack of numbers, and derivatives where functions
// have kinks and jumps. Argument-dependent lookup finds the overloads of Pack.h, and of Interval.h, whose ranges may
// contain kinks and jumps. Pack is declared, too, for headers that only name it.
#ifndef EQUIAFFINE_NUMBER_SELECT_H
#define EQUIAFFINE_NUMBER_SELECT_H

#include <equiaffine/base/internal/compiler.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
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

/// What the derivatives of fmod(a, b) get added to them, where r is its value: 0, or NaN where it jumps.
template <class T>
T jump_of_remainder(const T& a, const T&, const T& r) {
  return select(r == T(0) && a != T(0), T(std::numeric_limits<T>::quiet_NaN()), T(0));
}

} // namespace equiaffine

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

/// Whether the compiler has vectors as GCC and Clang have. Users may define EQUIAFFINE_WITHOUT_SIMD to do without.
#if defined(__GNUC__) && !defined(EQUIAFFINE_WITHOUT_SIMD)
inline constexpr bool has_simd = true;
#else
inline constexpr bool has_simd = false;
#endif

/// Numbers in a vector of the compiler; lanes.h defines it.
template <class T, std::size_t Size>
struct Simd_lanes;

/// Numbers in an array; lanes.h defines it.
template <class T, std::size_t Size>
struct Array_lanes;

/// The size of a vector register under the compiler's flags. It is part of the type of a pack, so that translation
/// units compiled for registers of different sizes have different packs, never two of one name.
#if defined(__AVX512F__)
inline constexpr std::size_t bytes_per_register = 64;
#elif defined(__AVX__)
inline constexpr std::size_t bytes_per_register = 32;
#else
inline constexpr std::size_t bytes_per_register = 16;
#endif

template <class T>
inline constexpr std::size_t native_size = sizeof(T) < bytes_per_register ? bytes_per_register / sizeof(T) : 1;

/// How packs keep their lanes.
template <class T>
using Native_lanes = std::conditional_t<has_simd && (std::is_same_v<T, double> || std::is_same_v<T, float>),
                                        Simd_lanes<T, native_size<T>>, Array_lanes<T, native_size<T>>>;

} // namespace equiaffine::internal

namespace equiaffine {

template <class T, class Lanes = internal::Native_lanes<T>>
struct Pack;

} // namespace equiaffine

#endif
