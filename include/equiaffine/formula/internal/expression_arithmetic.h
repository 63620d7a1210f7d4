// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_ARITHMETIC_H
#define EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_ARITHMETIC_H

#include <equiaffine/number/internal/own_steps.h>
#include <equiaffine/number/select.h>

#include <cmath>
#include <concepts>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

/// The operations and functions that the instructions of an expression need, for any number type.
namespace equiaffine::internal::expression {

// These functions compute with a T and a double. They use the mixed operators of T where these exist and return T: to
// scale a Taylor polynomial is many times cheaper than a product of two. A float would be promoted to double by such
// an operator; therefore the double is converted for built-in types.
template <class T>
T plus_constant(const T& a, double c) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { a + c } -> std::same_as<T>;
                })
    return a + c;
  else return a + T(c);
}

template <class T>
T constant_minus(double c, const T& a) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { c - a } -> std::same_as<T>;
                })
    return c - a;
  else return T(c) - a;
}

template <class T>
T times_constant(const T& a, double c) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { a* c } -> std::same_as<T>;
                })
    return a * c;
  else return a * T(c);
}

template <class T>
T over_constant(const T& a, double c) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { a / c } -> std::same_as<T>;
                })
    return a / c;
  else return a / T(c);
}

template <class T>
T constant_over(double c, const T& a) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { c / a } -> std::same_as<T>;
                })
    return c / a;
  else return T(c) / a;
}

// These functions have a substitute for types that lack them.
template <class T>
T squared(const T& a) {
  if constexpr (requires {
                  { square(a) } -> std::convertible_to<T>;
                })
    return square(a);
  else return a * a;
}

/// HasOwnPower tells whether T has its own pow(T, Exponent). The catch-all `pow` below loses against such a function,
/// but wins against one that would have to convert the exponent, such as pow(T, int) called with 1.5.
namespace own_power {

struct Absent {};

template <class Base, class Exponent>
Absent pow(const Base&, const Exponent&);

template <class T, class Exponent>
concept HasOwnPower = !std::is_arithmetic_v<T> && requires(const T& a, const Exponent& b) {
  { pow(a, b) } -> std::convertible_to<T>;
};

} // namespace own_power

template <class T>
T real_power(const T& a, const T& b) {
  if constexpr (std::is_arithmetic_v<T>) return std::pow(a, b);
  else if constexpr (own_power::HasOwnPower<T, T>) return pow(a, b);
  else return exp(T(b * log(a)));
}

template <class T>
T constant_power(const T& a, double c) {
  if constexpr (own_power::HasOwnPower<T, double>) return pow(a, c);
  else return real_power(a, T(c));
}

/// The lesser argument, or NaN if either is NaN, which std::min and std::fmin can hide. This holds for types without a
/// `min` of their own.
template <class T>
T minimum(const T& a, const T& b) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { min(a, b) } -> std::convertible_to<T>;
                })
    return min(a, b);
  else return a < b || a != a ? a : b;
}

/// The greater argument, with NaN as in minimum().
template <class T>
T maximum(const T& a, const T& b) {
  if constexpr (!std::is_arithmetic_v<T> && requires {
                  { max(a, b) } -> std::convertible_to<T>;
                })
    return max(a, b);
  else return a > b || a != a ? a : b;
}

/// The angle of (x, y). It is NaN at the origin, where the C library has a conventional value but no derivative exists.
template <class T>
T angle(const T& y, const T& x) {
  using std::atan2;
  const T result = atan2(y, x);
  if constexpr (is_built_in<T>) return select(y == T(0) && x == T(0), T(std::numeric_limits<T>::quiet_NaN()), result);
  else return result;
}

template <class T>
T hypotenuse(const T& a, const T& b) {
  if constexpr (std::is_arithmetic_v<T>) return std::hypot(a, b);
  else if constexpr (requires {
                       { hypot(a, b) } -> std::convertible_to<T>;
                     })
    return hypot(a, b);
  else return sqrt(T(squared(a) + squared(b)));
}

/// The sign, by `<` for types without a `sign` of their own.
template <class T>
T signum(const T& a) {
  if constexpr (requires {
                  { sign(a) } -> std::convertible_to<T>;
                })
    return sign(a);
  else return T(0) < a ? T(1) : a < T(0) ? T(-1) : a;
}

/// Throws std::domain_error, since a number type that has no such function cannot do with arithmetic alone.
[[noreturn]] inline void fail_without(const char* function) {
  throw std::domain_error(std::string("the number type of this evaluation has no function ") + function +
                          ": define one that argument-dependent lookup finds");
}

template <class T>
T error_function(const T& a) {
  using std::erf;
  if constexpr (own_steps::HasErf<T>) return erf(a);
  else fail_without("erf(T)");
}

template <class T>
T whole_part(const T& a) {
  using std::floor;
  if constexpr (own_steps::HasFloor<T>) return floor(a);
  else fail_without("floor(T)");
}

template <class T>
T remainder_of(const T& a, const T& b) {
  using std::fmod;
  if constexpr (own_steps::HasFmod<T>) return fmod(a, b);
  else fail_without("fmod(T, T)");
}

} // namespace equiaffine::internal::expression

#endif
