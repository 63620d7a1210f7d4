// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses how packs keep their lanes, and declares the choices without defining them.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_NATIVE_LANES_H
#define EQUIAFFINE_NUMBER_INTERNAL_NATIVE_LANES_H

#include <cstddef>

// Users may define EQUIAFFINE_WITHOUT_SIMD to keep std::experimental::simd out. It is defined here where there is none: the
// standard library of LLVM has a header of this name, but not all of its contents.
#if !defined(__GLIBCXX__) || !__has_include(<experimental/simd>)
#ifndef EQUIAFFINE_WITHOUT_SIMD
#define EQUIAFFINE_WITHOUT_SIMD
#endif
#endif

namespace equiaffine::internal {

/// Numbers in a std::experimental::simd; Simd_lanes.h defines it.
template <class T, std::size_t Size>
struct Simd_lanes;

/// Numbers in an array; Array_lanes.h defines it.
template <class T, std::size_t Size>
struct Array_lanes;

/// The size of a vector register under the compiler's flags. It is part of the type of a pack, so that translation
/// units compiled for different processors have different packs, never two of one name.
#if defined(__AVX512F__)
inline constexpr std::size_t bytes_per_register = 64;
#elif defined(__AVX__)
inline constexpr std::size_t bytes_per_register = 32;
#else
inline constexpr std::size_t bytes_per_register = 16;
#endif

template <class T>
inline constexpr std::size_t native_size = sizeof(T) < bytes_per_register ? bytes_per_register / sizeof(T) : 1;

#ifdef EQUIAFFINE_WITHOUT_SIMD
template <class T>
using Native_lanes = Array_lanes<T, native_size<T>>;
#else
template <class T>
using Native_lanes = Simd_lanes<T, native_size<T>>;
#endif

} // namespace equiaffine::internal

#endif
