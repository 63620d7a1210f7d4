// SPDX-License-Identifier: GPL-3.0-or-later
// This header refuses flags of the compiler under which the library does not compile, or computes something else. Every
// header includes it, if only through others.
#ifndef EQUIAFFINE_BASE_INTERNAL_COMPILER_H
#define EQUIAFFINE_BASE_INTERNAL_COMPILER_H

#include <bit>
#include <type_traits>

#if __cplusplus < 202002L
#error "equiaffine needs C++20: compile with -std=c++20 or a later standard"
#endif
// A NaN says where a function has no value, an infinite bound what intervals do not know, and error bounds count on the
// order of roundings.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || __FINITE_MATH_ONLY__
#error                                                                                                                 \
    "equiaffine needs NaN, infinity and the order of roundings: compile without -ffast-math, -Ofast, -ffinite-math-only and -fassociative-math"
#endif

namespace equiaffine::internal {

/// std::bit_cast, which libc++ has from version 14 on.
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
