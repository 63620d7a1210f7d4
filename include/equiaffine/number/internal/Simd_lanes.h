// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_NUMBER_INTERNAL_SIMD_LANES_H
#define EQUIAFFINE_NUMBER_INTERNAL_SIMD_LANES_H

#include <equiaffine/number/internal/native_lanes.h>
#include <equiaffine/number/internal/shared/elementary_functions.h>

#if defined(__GLIBCXX__) && __has_include(<experimental/simd>) && !defined(EQUIAFFINE_WITHOUT_SIMD) // has_simd

#include <bit>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>
#include <type_traits>

namespace equiaffine::internal {

/// The lanes of a pack as a std::experimental::simd. Array_lanes has the same members.
template <class T, std::size_t Size>
struct Simd_lanes {
  using Vector = std::experimental::simd<T, std::experimental::simd_abi::deduce_t<T, Size>>;
  using Mask = typename Vector::mask_type;
  static constexpr std::size_t size = Size;

  /// Lane i is f(i).
  template <class F>
  static Vector generate(F f) {
    alignas(Vector) T values[size];
    for (std::size_t i = 0; i < size; ++i) values[i] = f(i);
    return Vector(values, std::experimental::vector_aligned);
  }

  [[gnu::always_inline]] static bool all(const Mask& mask) { return all_of(mask); }
  [[gnu::always_inline]] static bool any(const Mask& mask) { return any_of(mask); }

  [[gnu::always_inline]] static Vector select(const Mask& condition, const Vector& yes, const Vector& no) {
    Vector r = no;
    where(condition, r) = yes;
    return r;
  }

  [[gnu::always_inline]] static Vector abs(const Vector& a) { return std::experimental::abs(a); }
  [[gnu::always_inline]] static Vector sqrt(const Vector& a) { return std::experimental::sqrt(a); }

  /// Does in each lane what internal::scaled_exponential does for a double.
  [[gnu::always_inline]] static Vector scaled_exponential(const Vector& k, const Vector& p) {
    using Integers = std::experimental::rebind_simd_t<std::int64_t, Vector>;
    using Table = Exponential_table;
    // A processor with AVX and without AVX2 has no register for the integers.
    if constexpr (!std::is_trivially_copyable_v<Integers>)
      return generate([&](std::size_t i) { return internal::scaled_exponential(k[i], p[i]); });
    else {
      const auto bits = std::bit_cast<Integers>(k);
      const Integers n = bits & (Table::size - 1);
      const Vector high([&](auto i) { return exponential_table.high[std::size_t(n[i])]; });
      const Vector low([&](auto i) { return exponential_table.low[std::size_t(n[i])]; });
      const Vector e = high + (low + high * p);
      return std::bit_cast<Vector>(std::bit_cast<Integers>(e) +
                                   ((bits >> std::countr_zero(unsigned(Table::size))) << 52));
    }
  }
};

} // namespace equiaffine::internal

#endif

#endif
