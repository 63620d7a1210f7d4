// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_SIGN_WORD_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_SIGN_WORD_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace equiaffine::internal {

/// The signs of at most 64 numbers. Bit i belongs to number i.
struct Sign_word {
  std::uint64_t positive = 0;  ///< numbers that are at least the isovalue
  std::uint64_t undefined = 0; ///< numbers that are NaN
};

#ifdef __SSE2__
/// Which of four numbers are at least the level, 32 bits for each.
inline __m128i are_positive(const float* x, float level) {
  return _mm_castps_si128(_mm_cmpge_ps(_mm_loadu_ps(x), _mm_set1_ps(level)));
}
inline __m128i are_positive(const double* x, double level) {
  const auto two = [&](const double* y) { return _mm_castpd_ps(_mm_cmpge_pd(_mm_loadu_pd(y), _mm_set1_pd(level))); };
  return _mm_castps_si128(_mm_shuffle_ps(two(x), two(x + 2), 0x88));
}

/// Bits that are all 0 unless one of eight numbers is NaN.
inline __m128 are_undefined(const float* x) { return _mm_cmpunord_ps(_mm_loadu_ps(x), _mm_loadu_ps(x + 4)); }
inline __m128 are_undefined(const double* x) {
  const auto four = [](const double* y) { return _mm_cmpunord_pd(_mm_loadu_pd(y), _mm_loadu_pd(y + 2)); };
  return _mm_castpd_ps(_mm_or_pd(four(x), four(x + 4)));
}

/// The signs of 16 numbers; adds to `undefined` whether one of them is NaN.
template <class FT>
std::uint64_t sixteen_signs(const FT* x, FT level, __m128& undefined) {
  undefined = _mm_or_ps(undefined, _mm_or_ps(are_undefined(x), are_undefined(x + 8)));
  const __m128i low = _mm_packs_epi32(are_positive(x, level), are_positive(x + 4, level));
  const __m128i high = _mm_packs_epi32(are_positive(x + 8, level), are_positive(x + 12, level));
  return std::uint64_t(unsigned(_mm_movemask_epi8(_mm_packs_epi16(low, high))));
}

/// Returns nothing if a number is NaN.
template <class FT>
std::optional<Sign_word> sign_word_without_undefined(const FT* values, std::size_t n, FT isovalue) {
  Sign_word word;
  __m128 undefined = _mm_setzero_ps();
  std::size_t i = 0;
  for (; i + 16 <= n; i += 16) word.positive |= sixteen_signs(values + i, isovalue, undefined) << i;
  if (i < n) {
    FT rest[16] = {};
    std::copy(values + i, values + n, rest);
    word.positive |= (sixteen_signs(rest, isovalue, undefined) & ((std::uint64_t(1) << (n - i)) - 1)) << i;
  }
  return _mm_movemask_ps(undefined) == 0 ? std::optional(word) : std::nullopt;
}
#endif

/// The signs of n numbers. \pre n <= 64
template <class FT>
Sign_word sign_word(const FT* values, std::size_t n, const FT& isovalue) {
#ifdef __SSE2__
  if constexpr (std::is_same_v<FT, float> || std::is_same_v<FT, double>)
    if (const auto word = sign_word_without_undefined(values, n, isovalue)) return *word;
#endif
  Sign_word word;
  for (std::size_t i = 0; i < n; ++i) {
    word.positive |= std::uint64_t(values[i] >= isovalue) << i;
    word.undefined |= std::uint64_t(!(values[i] >= isovalue) && !(values[i] < isovalue)) << i;
  }
  return word;
}

} // namespace equiaffine::internal

#endif
