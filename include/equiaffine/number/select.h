// SPDX-License-Identifier: GPL-3.0-or-later
// Choices without branches, so that one formula serves numbers and packs, and derivatives at kinks and jumps. Pack.h
// and Interval.h overload these functions, found by argument-dependent lookup. Pack is declared here for headers that
// only name it.
#ifndef EQUIAFFINE_NUMBER_SELECT_H
#define EQUIAFFINE_NUMBER_SELECT_H

#include <equiaffine/base/internal/compiler.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace equiaffine {

/// The type of a comparison of two numbers: bool, or one truth value per lane.
template <class FT>
using Mask_of = decltype(std::declval<const FT&>() < std::declval<const FT&>());

/// Returns `yes` or `no`. The overload for packs chooses in each lane.
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

/// Whether FT is a hardware floating-point type up to double, or a pack of such numbers.
template <class FT>
inline constexpr bool is_built_in =
    std::numeric_limits<FT>::is_iec559&& std::numeric_limits<FT>::digits <= std::numeric_limits<double>::digits;

/// P / Q. For built-in numbers and their packs the division happens at compile time; with -frounding-math, which CGAL
/// sets, the compiler would otherwise divide in every call.
template <int P, int Q, class FT>
FT fraction() {
  if constexpr (is_built_in<FT>) {
    constexpr double quotient = double(P) / Q;
    return FT(quotient);
  } else {
    return FT(P) / FT(Q);
  }
}

/// The coefficient of a monomial of the given degree in the jet of max(u, v), if the jets of u and v have the
/// coefficients `a` and `b`. At the kink u = v, the coefficient of degree 0 is correct and the others are NaN.
template <class T>
T branch_or_kink(const T& u, const T& v, const T& a, const T& b, int degree) {
  return u > v ? a : v > u ? b : degree == 0 ? (u == v ? a : T(u + v)) : std::numeric_limits<T>::quiet_NaN();
}

/// The factor of the derivatives of atan2(y, x) due to its jump along the negative x-axis. It is 1 for numbers, since a
/// point lies on one side of the jump.
template <class T>
T factor_for_jump(const T&, const T&) {
  return T(1);
}

/// The term added to the derivatives of fmod(a, b), given its value r: 0, or NaN at a jump.
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

/// Whether the compiler supports the vector types of GCC and Clang. Define EQUIAFFINE_WITHOUT_SIMD to disable them.
#if defined(__GNUC__) && !defined(EQUIAFFINE_WITHOUT_SIMD)
inline constexpr bool has_simd = true;
#else
inline constexpr bool has_simd = false;
#endif

/// Lanes in a vector type of the compiler; see lanes.h.
template <class T, std::size_t Size>
struct Simd_lanes;

/// Lanes in an array; see lanes.h.
template <class T, std::size_t Size>
struct Array_lanes;

/// The size of a vector register under the compiler's flags. It is part of the type of a pack: translation units
/// compiled for different registers have different pack types, never two types with one name.
#if defined(__AVX512F__)
inline constexpr std::size_t bytes_per_register = 64;
#elif defined(__AVX__)
inline constexpr std::size_t bytes_per_register = 32;
#else
inline constexpr std::size_t bytes_per_register = 16;
#endif

template <class T>
inline constexpr std::size_t native_size = sizeof(T) < bytes_per_register ? bytes_per_register / sizeof(T) : 1;

/// The default storage of lanes.
template <class T>
using Native_lanes = std::conditional_t<has_simd && (std::is_same_v<T, double> || std::is_same_v<T, float>),
                                        Simd_lanes<T, native_size<T>>, Array_lanes<T, native_size<T>>>;

} // namespace equiaffine::internal

namespace equiaffine {

template <class T, class Lanes = internal::Native_lanes<T>>
struct Pack;

} // namespace equiaffine

#endif
