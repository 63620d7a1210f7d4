// SPDX-License-Identifier: GPL-3.0-or-later
// Two ways to store the lanes of a pack. They have the same members and bitwise equal results.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_LANES_H
#define EQUIAFFINE_NUMBER_INTERNAL_LANES_H

#include <equiaffine/number/internal/elementary_functions.h>
#include <equiaffine/number/select.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace equiaffine::internal {

/// The lanes of a pack as an array, for compilers without vector types.
template <class T, std::size_t Size>
struct Array_lanes {
  static constexpr std::size_t size = Size;

  class Mask {
  public:
    Mask() = default;
    explicit Mask(bool value) {
      for (bool& lane : values_) lane = value;
    }

    bool operator[](std::size_t lane) const { return values_[lane]; }

    Mask operator!() const {
      return generate_mask([&](std::size_t i) { return !values_[i]; });
    }
    friend Mask operator&&(const Mask& a, const Mask& b) {
      return generate_mask([&](std::size_t i) { return bool(int(a[i]) & int(b[i])); });
    }
    friend Mask operator||(const Mask& a, const Mask& b) {
      return generate_mask([&](std::size_t i) { return bool(int(a[i]) | int(b[i])); });
    }

  private:
    friend Array_lanes;
    bool values_[Size];
  };

  class Vector {
  public:
    Vector() = default;
    Vector(const T& value) {
      for (T& lane : values_) lane = value;
    }

    T operator[](std::size_t lane) const { return values_[lane]; }

    Vector operator-() const {
      return generate([&](std::size_t i) { return -values_[i]; });
    }
    friend Vector operator+(const Vector& a, const Vector& b) {
      return generate([&](std::size_t i) { return a[i] + b[i]; });
    }
    friend Vector operator-(const Vector& a, const Vector& b) {
      return generate([&](std::size_t i) { return a[i] - b[i]; });
    }
    friend Vector operator*(const Vector& a, const Vector& b) {
      return generate([&](std::size_t i) { return a[i] * b[i]; });
    }
    friend Vector operator/(const Vector& a, const Vector& b) {
      return generate([&](std::size_t i) { return a[i] / b[i]; });
    }

    friend Mask operator<(const Vector& a, const Vector& b) {
      return generate_mask([&](std::size_t i) { return a[i] < b[i]; });
    }
    friend Mask operator>(const Vector& a, const Vector& b) { return b < a; }
    friend Mask operator<=(const Vector& a, const Vector& b) {
      return generate_mask([&](std::size_t i) { return a[i] <= b[i]; });
    }
    friend Mask operator>=(const Vector& a, const Vector& b) { return b <= a; }
    friend Mask operator==(const Vector& a, const Vector& b) {
      return generate_mask([&](std::size_t i) { return a[i] == b[i]; });
    }
    friend Mask operator!=(const Vector& a, const Vector& b) { return !(a == b); }

  private:
    friend Array_lanes;
    T values_[Size];
  };

  /// The vector with f(i) in lane i.
  template <class F>
  static Vector generate(F f) {
    Vector result;
    for (std::size_t i = 0; i < size; ++i) result.values_[i] = f(i);
    return result;
  }

  template <class F>
  static Mask generate_mask(F f) {
    Mask result;
    for (std::size_t i = 0; i < size; ++i) result.values_[i] = f(i);
    return result;
  }

  static bool all(const Mask& mask) {
    bool result = true;
    for (std::size_t i = 0; i < size; ++i) result &= mask[i];
    return result;
  }
  static bool any(const Mask& mask) { return !all(!mask); }

  static Vector select(const Mask& condition, const Vector& yes, const Vector& no) {
    return generate([&](std::size_t i) { return condition[i] ? yes[i] : no[i]; });
  }

  static Vector abs(const Vector& a) {
    return generate([&](std::size_t i) { return std::abs(a[i]); });
  }
  static Vector sqrt(const Vector& a) {
    return generate([&](std::size_t i) { return std::sqrt(a[i]); });
  }
  static Vector scaled_exponential(const Vector& k, const Vector& p) {
    return generate([&](std::size_t i) { return internal::scaled_exponential(k[i], p[i]); });
  }
};

#if defined(__GNUC__) && !defined(EQUIAFFINE_WITHOUT_SIMD) // has_simd

/// A vector type of the compiler. It must be defined outside of the template that uses it to be a distinct type.
template <class T, std::size_t Size>
struct Register {
  typedef T type __attribute__((vector_size(Size * sizeof(T))));
};

/// The lanes of a pack as a vector type of GCC and Clang. <experimental/simd> is not used: Clang's library lacks it,
/// and it takes half as long to compile as CGAL::Surface_mesh.
template <class T, std::size_t Size>
struct Simd_lanes {
  static constexpr std::size_t size = Size;

private:
  using Indices = std::make_index_sequence<Size>;
  using Integer = std::conditional_t<sizeof(T) == sizeof(std::uint64_t), std::uint64_t, std::uint32_t>;
  static_assert(sizeof(T) == sizeof(Integer));
  using Numbers = typename Register<T, Size>::type;
  using Integers = typename Register<Integer, Size>::type;

  template <class Lanes, class F, std::size_t... I>
  [[gnu::always_inline]] static Lanes fill(const F& f, std::index_sequence<I...>) {
    return Lanes{f(I)...};
  }

public:
  /// All bits of a lane are set if the value is true, and none if it is false.
  struct Mask {
    Integers bits;

    Mask() = default;
    [[gnu::always_inline]] Mask(const Integers& values) : bits(values) {}
    [[gnu::always_inline]] explicit Mask(bool value)
        : bits(fill<Integers>([&](std::size_t) { return value ? ~Integer() : Integer(); }, Indices())) {}

    bool operator[](std::size_t lane) const { return bits[lane] != 0; }

    [[gnu::always_inline]] Mask operator!() const { return ~bits; }
    [[gnu::always_inline]] friend Mask operator&&(const Mask& a, const Mask& b) { return a.bits & b.bits; }
    [[gnu::always_inline]] friend Mask operator||(const Mask& a, const Mask& b) { return a.bits | b.bits; }
  };

  struct Vector {
    Numbers numbers;

    Vector() = default;
    [[gnu::always_inline]] Vector(const Numbers& values) : numbers(values) {}
    [[gnu::always_inline]] Vector(const T& value)
        : numbers(fill<Numbers>([&](std::size_t) { return value; }, Indices())) {}

    T operator[](std::size_t lane) const { return numbers[lane]; }

    [[gnu::always_inline]] Vector operator-() const { return -numbers; }
    [[gnu::always_inline]] friend Vector operator+(const Vector& a, const Vector& b) { return a.numbers + b.numbers; }
    [[gnu::always_inline]] friend Vector operator-(const Vector& a, const Vector& b) { return a.numbers - b.numbers; }
    [[gnu::always_inline]] friend Vector operator*(const Vector& a, const Vector& b) { return a.numbers * b.numbers; }
    [[gnu::always_inline]] friend Vector operator/(const Vector& a, const Vector& b) { return a.numbers / b.numbers; }

#define EQUIAFFINE_COMPARISON(op)                                                                                      \
  [[gnu::always_inline]] friend Mask operator op(const Vector& a, const Vector& b) {                                   \
    return Mask((Integers)(a.numbers op b.numbers));                                                                   \
  }
    EQUIAFFINE_COMPARISON(<)
    EQUIAFFINE_COMPARISON(>)
    EQUIAFFINE_COMPARISON(<=)
    EQUIAFFINE_COMPARISON(>=)
    EQUIAFFINE_COMPARISON(==)
    EQUIAFFINE_COMPARISON(!=)
#undef EQUIAFFINE_COMPARISON
  };

  /// The vector with f(i) in lane i.
  template <class F>
  static Vector generate(const F& f) {
    return fill<Numbers>(f, Indices());
  }

  [[gnu::always_inline]] static bool all(const Mask& mask) { return all_bits(mask.bits); }
  [[gnu::always_inline]] static bool any(const Mask& mask) { return !all_bits(~mask.bits); }

  [[gnu::always_inline]] static Vector select(const Mask& condition, const Vector& yes, const Vector& no) {
    return condition.bits ? yes.numbers : no.numbers;
  }

  [[gnu::always_inline]] static Vector abs(const Vector& a) {
    return (Numbers)((Integers)a.numbers & (~Integer() >> 1));
  }

  [[gnu::always_inline]] static Vector sqrt(const Vector& a) { return square_roots(a.numbers); }

  /// internal::scaled_exponential() of a double in each lane.
  [[gnu::always_inline]] static Vector scaled_exponential(const Vector& k, const Vector& p) {
    using Table = Exponential_table;
    const Integers bits = (Integers)k.numbers;
    const Integers n = bits & (Table::size - 1);
    const Vector high = generate([&](std::size_t i) { return exponential_table.high[n[i]]; });
    const Vector low = generate([&](std::size_t i) { return exponential_table.low[n[i]]; });
    const Vector e = high + (low + high * p);
    return (Numbers)((Integers)e.numbers + ((bits >> std::countr_zero(unsigned(Table::size))) << 52));
  }

private:
  /// Whether all bits of all lanes are set.
  [[gnu::always_inline]] static bool all_bits(const Integers& lanes) {
    return [&]<std::size_t... I>(std::index_sequence<I...>) { return (lanes[I] & ...) == ~Integer(); }
    (Indices());
  }

  /// The processor's square roots. std::sqrt would have to set errno for negative numbers, one by one.
  [[gnu::always_inline]] static Numbers square_roots(const Numbers& a) {
#if __has_builtin(__builtin_elementwise_sqrt)
    return __builtin_elementwise_sqrt(a);
#else
    [[maybe_unused]] constexpr bool is_double = std::is_same_v<T, double>;
#if defined(__AVX512F__) && defined(__clang__)
    if constexpr (sizeof(a) == 64 && is_double) return __builtin_ia32_sqrtpd512(a, 4);
    if constexpr (sizeof(a) == 64 && !is_double) return __builtin_ia32_sqrtps512(a, 4);
#elif defined(__AVX512F__)
    if constexpr (sizeof(a) == 64 && is_double) return __builtin_ia32_sqrtpd512_mask(a, a, -1, 4);
    if constexpr (sizeof(a) == 64 && !is_double) return __builtin_ia32_sqrtps512_mask(a, a, -1, 4);
#endif
#if defined(__AVX__)
    if constexpr (sizeof(a) == 32 && is_double) return __builtin_ia32_sqrtpd256(a);
    if constexpr (sizeof(a) == 32 && !is_double) return __builtin_ia32_sqrtps256(a);
#endif
#if defined(__SSE2__)
    if constexpr (sizeof(a) == 16 && is_double) return __builtin_ia32_sqrtpd(a);
    if constexpr (sizeof(a) == 16 && !is_double) return __builtin_ia32_sqrtps(a);
#endif
    return fill<Numbers>([&](std::size_t i) { return std::sqrt(a[i]); }, Indices());
#endif
  }
};

#endif

} // namespace equiaffine::internal

#endif
