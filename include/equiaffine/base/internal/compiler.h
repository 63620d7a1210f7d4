// SPDX-License-Identifier: GPL-3.0-or-later
// Rejects compiler flags under which the library does not compile or gives wrong results. Every header includes this
// one, directly or indirectly.
#ifndef EQUIAFFINE_BASE_INTERNAL_COMPILER_H
#define EQUIAFFINE_BASE_INTERNAL_COMPILER_H

#include <bit>
#include <type_traits>

#if __cplusplus < 202002L
#error "equiaffine needs C++20: compile with -std=c++20 or a later standard"
#endif
// The library uses NaN for undefined values and infinity for unknown bounds; error bounds depend on the order of
// rounding.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || __FINITE_MATH_ONLY__
#error                                                                                                                 \
    "equiaffine needs NaN, infinity and the given order of operations: compile without -ffast-math, -Ofast, -ffinite-math-only and -fassociative-math"
#endif

namespace equiaffine::internal {

/// std::bit_cast, which libc++ provides from version 14.
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
#ifdef __cpp_lib_bit_cast
  return std::bit_cast<To>(from);
#else
  return __builtin_bit_cast(To, from);
#endif
}

} // namespace equiaffine::internal

#endif
