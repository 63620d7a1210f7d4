// SPDX-License-Identifier: GPL-3.0-or-later
// Declares Pack, for headers that only name it, and chooses how packs keep their lanes.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_PACK_FWD_H
#define EQUIAFFINE_NUMBER_INTERNAL_PACK_FWD_H

#include <cstddef>
#include <type_traits>

namespace equiaffine::internal {

/// Whether the compiler has vectors as GCC and Clang have. Users may define EQUIAFFINE_WITHOUT_SIMD to do without.
#if defined(__GNUC__) && !defined(EQUIAFFINE_WITHOUT_SIMD)
inline constexpr bool has_simd = true;
#else
inline constexpr bool has_simd = false;
#endif

/// Numbers in a vector of the compiler; Simd_lanes.h defines it.
template <class T, std::size_t Size>
struct Simd_lanes;

/// Numbers in an array; Array_lanes.h defines it.
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

template <class T>
using Native_lanes = std::conditional_t<has_simd && (std::is_same_v<T, double> || std::is_same_v<T, float>),
                                        Simd_lanes<T, native_size<T>>, Array_lanes<T, native_size<T>>>;

} // namespace equiaffine::internal

namespace equiaffine {

template <class T, class Lanes = internal::Native_lanes<T>>
struct Pack;

} // namespace equiaffine

#endif
