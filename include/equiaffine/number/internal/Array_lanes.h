// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_NUMBER_INTERNAL_ARRAY_LANES_H
#define EQUIAFFINE_NUMBER_INTERNAL_ARRAY_LANES_H

#include <equiaffine/number/internal/Pack_fwd.h>
#include <equiaffine/number/internal/elementary_functions.h>

#include <cmath>
#include <cstddef>

namespace equiaffine::internal {

/// The lanes of a pack as an array, for compilers without vectors. Simd_lanes has the same members, and results are the
/// same bit for bit.
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

  /// Lane i is f(i).
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

} // namespace equiaffine::internal

#endif
