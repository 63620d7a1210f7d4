// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary functions of numbers and packs. exp, sin and cos use arithmetic only, without calls of the C library. A
// lane of a pack is bitwise equal to a single number for any instruction set, unless the compiler contracts products
// and sums. Method: argument reduction after Cody and Waite, then a Taylor polynomial (Muller, Elementary Functions,
// 2016, section 11.2).
#ifndef EQUIAFFINE_NUMBER_INTERNAL_ELEMENTARY_FUNCTIONS_H
#define EQUIAFFINE_NUMBER_INTERNAL_ELEMENTARY_FUNCTIONS_H

#include <equiaffine/base/internal/compiler.h>
#include <equiaffine/number/internal/exponential_table.h>
#include <equiaffine/number/select.h>

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace equiaffine::internal {

/// The largest absolute values of arguments for this method. Beyond them, and for NaN, the C library is called.
inline constexpr double exponential_range = 708, circular_range = 1000;

/// The integer nearest to x, |x| < 2^51, for rounding to nearest.
template <class T>
T nearest_integer(const T& x) {
  constexpr double shift = 0x1.8p52;
  return (x + T(shift)) - T(shift);
}

/// 2^(k / 128) (1 + p) for small p and an integer k. The argument is k + 1.5 2^52, whose low bits are those of k.
inline double scaled_exponential(double k, double p) {
  const auto bits = bit_cast<std::int64_t>(k);
  const auto n = std::size_t(bits % Exponential_table::size);
  const double e = exponential_table.high[n] + (exponential_table.low[n] + exponential_table.high[n] * p);
  return bit_cast<double>(bit_cast<std::int64_t>(e) + ((bits / Exponential_table::size) << 52));
}

/// The sum c[First] + c[First + 1] x + ... of `Size` terms, by Estrin's scheme; powers[k] = x^(2^k).
template <std::size_t First, std::size_t Size, class T, std::size_t N>
T polynomial(const std::array<double, N>& c, const std::array<T, 4>& powers) {
  if constexpr (Size == 1) {
    return T(c[First]);
  } else {
    constexpr std::size_t half = std::bit_ceil(Size) / 2;
    return polynomial<First, half>(c, powers) +
           powers[std::size_t(std::countr_zero(half))] * polynomial<First + half, Size - half>(c, powers);
  }
}

template <class T, std::size_t N>
T polynomial(const std::array<double, N>& c, const T& x) {
  const T x2 = x * x, x4 = x2 * x2;
  return polynomial<0, N>(c, std::array<T, 4>{x, x2, x4, x4 * x4});
}

/// 1 / first!, 1 / (first + step)!, ..., with alternating signs if step is 2.
template <std::size_t N>
constexpr std::array<double, N> inverse_factorials(int first, int step) {
  std::array<double, N> c{};
  double factorial = 1;
  for (int n = 2; n < first; ++n) factorial *= n;
  for (std::size_t i = 0; i < N; ++i) {
    for (int n = i == 0 ? first : first + int(i) * step - step + 1; n <= first + int(i) * step; ++n) factorial *= n;
    c[i] = (step == 2 && i % 2 == 1 ? -1 : 1) / factorial;
  }
  return c;
}

/// e^x for |x| <= exponential_range, with an error below 0.6 units in the last place.
template <class T>
T exponential_in_range(const T& x) {
  constexpr double high = 0x1.62e42fef8p-8, low = 0x1.1cf79abc9e3b4p-43; // ln 2 / 128
  const T shifted = x * T(0x1.71547652b82fep+7) + T(0x1.8p52), k = shifted - T(0x1.8p52);
  const T r = (x - k * T(high)) - k * T(low), r2 = r * r;
  const T p = r + r2 * ((T(0.5) + r * T(1. / 6)) + r2 * (T(1. / 24) + r * T(1. / 120)));
  return scaled_exponential(shifted, p);
}

/// (sin x, cos x) for |x| <= circular_range, with errors below 0.9 units in the last place.
template <class T>
std::pair<T, T> sine_and_cosine_in_range(const T& x) {
  constexpr auto of_sine = inverse_factorials<8>(3, 2);
  constexpr auto of_cosine = inverse_factorials<7>(4, 2);
  constexpr double first = 0x1.921fb54442800p+0, second = 0x1.4611a62633000p-42,
                   third = 0x1.45c06e0e68948p-86; // pi / 2
  const T k = nearest_integer(T(x * T(0x1.45f306dc9c883p-1)));
  const T a = x - k * T(first), b = k * T(second); // exact
  const T c = a - b, taken = a - c;
  const T rest = ((a - (c + taken)) + (taken - b)) - k * T(third);
  const T r = c + rest, low = (c - r) + rest;
  const T z = r * r, half_z = T(0.5) * z, one_minus = T(1) - half_z;
  const T s = r + (low * one_minus - r * z * polynomial(of_sine, z));
  const T q = one_minus + (((T(1) - one_minus) - half_z) + (z * z * polynomial(of_cosine, z) - r * low));
  // x = r + k pi / 2, so the last two bits of k determine which of s and q is the sine, and their signs.
  const T half = k * T(0.5);
  const auto is_odd = nearest_integer(half) != half;
  const T quarter = select(is_odd, T(half - T(0.5)), half) * T(0.5);
  const T sign = select(nearest_integer(quarter) != quarter, T(-1), T(1));
  return {sign * select(is_odd, q, s), sign * select(is_odd, T(-s), q)};
}

/// exp(x). For doubles the result is bitwise equal to that of a lane of a pack.
template <class T>
T exp_value(const T& x) {
  using std::exp;
  if constexpr (std::is_same_v<T, double>)
    if (std::abs(x) <= exponential_range) return exponential_in_range(x);
  return exp(x);
}

/// (sin x, cos x). For doubles the results are bitwise equal to those of lanes of packs.
template <class T>
std::pair<T, T> sine_and_cosine(const T& x) {
  using std::cos;
  using std::sin;
  if constexpr (std::is_same_v<T, double>)
    if (std::abs(x) <= circular_range) return sine_and_cosine_in_range(x);
  return {sin(x), cos(x)};
}

/// x^n by repeated squaring (error up to n / 2 units in the last place), or by std::pow for floating-point x and n > 8.
template <class T>
T natural_power(T x, unsigned n) {
  if constexpr (std::is_floating_point_v<T>)
    if (n > 8) return std::pow(x, T(n));
  T r(1);
  for (bool first = true; n > 0; n >>= 1) {
    if (n & 1) {
      r = first ? x : r * x;
      first = false;
    }
    if (n > 1) x = x * x;
  }
  return r;
}

/// Detects number types that have these functions, as their own or in the standard library.
namespace own_functions {

using std::erf, std::floor, std::fmod;

template <class T>
concept HasErf = requires(const T& a) {
  { erf(a) } -> std::convertible_to<T>;
};
template <class T>
concept HasFloor = requires(const T& a) {
  { floor(a) } -> std::convertible_to<T>;
};
template <class T>
concept HasFmod = requires(const T& a) {
  { fmod(a, a) } -> std::convertible_to<T>;
};

} // namespace own_functions

} // namespace equiaffine::internal

#endif
