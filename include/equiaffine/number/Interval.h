// SPDX-License-Identifier: GPL-3.0-or-later
// Interval, closed intervals of reals with outward rounding, and their elementary functions.
#ifndef EQUIAFFINE_NUMBER_INTERVAL_H
#define EQUIAFFINE_NUMBER_INTERVAL_H

#include <equiaffine/base/internal/compiler.h>
#include <equiaffine/number/internal/elementary_functions.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <exception>
#include <limits>
#include <numbers>
#include <type_traits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace equiaffine {

/// Thrown by a comparison of intervals if its result is not the same for all numbers in them. The caller must then do
/// without bounds.
struct Undecided_comparison : std::exception {
  /// The message of the exception.
  const char* what() const noexcept override { return "a comparison of intervals is undecided"; }
};

/// A closed interval [lower, upper] of reals with outward-rounded arithmetic: the result of a function contains its
/// values at all points of the arguments (Moore, Kearfott, Cloud: Introduction to Interval Analysis, 2009).
///
/// Each computed bound is widened; the processor's rounding mode is never changed. Results therefore do not depend on
/// compiler flags, threads keep their rounding modes, and clang and vectorization are safe. Sums, products, quotients
/// and square roots are widened by one unit in the last place, other functions by eight (exp needs less than 1; glibc
/// documents at most 3 for the others). Overflow is not detected in threads that round downwards or towards zero.
///
/// If a bound is NaN, or a function is evaluated partly outside its domain, an unknown result is the whole real line.
/// As usual, sqrt, log and similar functions use the part of the argument inside the domain; if there is none, the
/// result is the whole real line.
class Interval {
  using Limits = std::numeric_limits<double>;

public:
  Interval() = default; ///< leaves the bounds uninitialized

  /// The interval [value, value], or its neighboring doubles if a double cannot represent the value. For infinity and
  /// NaN see the constructor from two bounds.
  template <class Number>
  Interval(Number value) requires(std::is_arithmetic_v<Number>) : outwards_{-double(value), double(value)} {
    const double x = double(value);
    if (!std::isfinite(x)) *this = Interval(x, x);
    if constexpr (std::numeric_limits<Number>::digits > Limits::digits)
      if (value == value && static_cast<long double>(x) != static_cast<long double>(value)) *this = widened(x, x);
  }

  /// The interval from `lower` to `upper`. A lower bound of +infinity becomes the largest double, an upper bound of
  /// -infinity the lowest. Unless lower <= upper, for example if a bound is NaN, the result is the whole real line.
  Interval(double lower, double upper)
      : Interval(lower <= upper ? greater(Outwards{-lower, upper}, repeated(Limits::lowest()))
                                : repeated(Limits::infinity())) {}

  static Interval whole() { return repeated(Limits::infinity()); } ///< all reals

  double lower() const { return -outwards_[0]; }                         ///< the lower bound
  double upper() const { return outwards_[1]; }                          ///< the upper bound
  bool contains(double x) const { return lower() <= x && x <= upper(); } ///< whether x is in the interval

  Interval operator-() const { return swapped(outwards_); } ///< the negated interval
  Interval operator+() const { return *this; }              ///< the same interval

  /// @{
  /// Outward-rounded arithmetic.
  friend Interval operator+(const Interval& a, const Interval& b) { return rounded(a.outwards_ + b.outwards_); }
  friend Interval operator-(const Interval& a, const Interval& b) {
    return rounded(a.outwards_ + swapped(b.outwards_));
  }
  /// An interval times itself is a square, hence never negative.
  friend Interval operator*(const Interval& a, const Interval& b) {
    if (&a == &b) return square(a);
    const Outwards p = a.outwards_ * b.outwards_, q = a.outwards_ * swapped(b.outwards_);
    const Outwards least =
        lesser(greater(p, -p), greater(q, -q)); // a lane is NaN or zero if one of its products is NaN
    if (!(least[0] >= smallest_normal && least[1] >= smallest_normal)) return special_product(a, b);
    const Outwards lower = greater(-p, q), upper = greater(p, -q);
    return rounded(greater(__builtin_shufflevector(lower, upper, 0, 2), __builtin_shufflevector(lower, upper, 1, 3)));
  }
  friend Interval operator/(const Interval& a, const Interval& b) {
    if (b.contains(0)) return whole();
    const double p = quotient(a.lower(), b.lower()), q = quotient(a.lower(), b.upper());
    const double r = quotient(a.upper(), b.lower()), s = quotient(a.upper(), b.upper());
    return widened(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
  }
  Interval& operator+=(const Interval& b) { return *this = *this + b; }
  Interval& operator-=(const Interval& b) { return *this = *this - b; }
  Interval& operator*=(const Interval& b) { return *this = *this * b; }
  Interval& operator/=(const Interval& b) { return *this = *this / b; }
  /// @}

  /// Whether both bounds are equal.
  friend bool operator==(const Interval& a, const Interval& b) {
    return a.lower() == b.lower() && a.upper() == b.upper();
  }

  /// @{
  /// A comparison returns its result if it is the same for all numbers in the intervals. So code with branches works on
  /// intervals that take one branch. \throw Undecided_comparison if the result differs
  friend bool operator<(const Interval& a, const Interval& b) {
    if (a.upper() < b.lower()) return true;
    if (a.lower() >= b.upper()) return false;
    throw Undecided_comparison();
  }
  friend bool operator>(const Interval& a, const Interval& b) { return b < a; }
  friend bool operator<=(const Interval& a, const Interval& b) { return !(b < a); }
  friend bool operator>=(const Interval& a, const Interval& b) { return !(a < b); }

  friend Interval select(bool condition, const Interval& yes, const Interval& no) { return condition ? yes : no; }
  /// @}

  /// The squares of the numbers in an interval.
  friend Interval square(const Interval& a) {
    const Outwards s = swapped(a.outwards_);
    const double least = std::max(-lesser(a.outwards_, s)[0], 0.0), largest = greater(a.outwards_, s)[0]; // of |a|
    const Outwards squares = Outwards{least, largest} * Outwards{-least, largest};
    if (largest >= smallest_normal_root && (least == 0 || least >= smallest_normal_root)) return rounded(squares);
    if (largest == 0) return a;
    const Interval r = widened(squares, 1);
    return Interval(std::max(r.lower(), 0.0), r.upper());
  }

  /// [lower, upper] widened on each side by `ulps` units in the last place and by the smallest normal number. A bound
  /// that overflowed inwards is replaced by the largest double.
  static Interval widened(double lower, double upper, int ulps = 1) {
    return lower <= upper ? widened(Outwards{-lower, upper}, ulps) : whole();
  }

  /// The smallest interval that contains both.
  static Interval hull(const Interval& a, const Interval& b) { return greater(a.outwards_, b.outwards_); }

  /// The intersection of two bounds of the same number; the whole real line if they are disjoint.
  static Interval intersection(const Interval& a, const Interval& b) {
    const Interval r = lesser(a.outwards_, b.outwards_);
    return r.lower() <= r.upper() ? r : whole();
  }

private:
  /// The pair (-lower, upper). Both numbers grow outwards; neither is NaN or -infinity.
  typedef double Outwards __attribute__((vector_size(2 * sizeof(double))));

  /// A product below `smallest_normal` may have been rounded to a subnormal number, and so may the square of a number
  /// below `smallest_normal_root`.
  static constexpr double smallest_normal = Limits::min() / Limits::epsilon(), smallest_normal_root = 0x1p-485;

  Interval(const Outwards& outwards) : outwards_(outwards) {}

  static Outwards repeated(double x) { return Outwards{x, x}; }
  static Outwards swapped(const Outwards& x) { return __builtin_shufflevector(x, x, 1, 0); }

  // Both return the second argument if only the first is NaN. GCC compiles the conditional expressions to three
  // instructions if an argument is constant.
#ifdef __SSE2__
  static Outwards greater(const Outwards& x, const Outwards& y) { return _mm_max_pd(x, y); }
  static Outwards lesser(const Outwards& x, const Outwards& y) { return _mm_min_pd(x, y); }
#else
  static Outwards greater(const Outwards& x, const Outwards& y) { return x > y ? x : y; }
  static Outwards lesser(const Outwards& x, const Outwards& y) { return x < y ? x : y; }
#endif

  static Interval widened(const Outwards& outwards, int ulps) {
    return rounded(outwards, ulps).outwards_ + repeated(Limits::min());
  }

  /// Widens bounds that are exact if they are subnormal, as sums are; so the smallest normal number is not added. It
  /// could lead to subnormal numbers, which slow down all further computation.
  static Interval rounded(const Outwards& outwards, int ulps = 1) {
    const Outwards x = greater(outwards, repeated(Limits::lowest()));
    return greater(x * (1 + Limits::epsilon() * ulps), x * (1 - Limits::epsilon() * ulps));
  }

  /// The product if a factor is zero, infinite, or so small that a product of bounds may be subnormal.
  static Interval special_product(const Interval& a, const Interval& b) {
    if ((a.lower() == 0 && a.upper() == 0) || (b.lower() == 0 && b.upper() == 0)) return Interval(0.0, 0.0);
    double lower = Limits::infinity(), upper = -Limits::infinity();
    bool is_exact_if_small = true;
    for (const double x : {a.lower(), a.upper()})
      for (const double y : {b.lower(), b.upper()}) {
        const double p = product(x, y);
        lower = std::min(lower, p);
        upper = std::max(upper, p);
        is_exact_if_small = is_exact_if_small && (x == 0 || y == 0 || std::abs(p) >= smallest_normal);
      }
    return is_exact_if_small ? rounded(Outwards{-lower, upper}) : widened(lower, upper);
  }

  // Infinite bounds are limits: 0 times infinity is 0, and a number divided by infinity tends to 0.
  static double product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }
  static double quotient(double a, double b) { return std::isinf(b) ? 0 : a / b; }

  Outwards outwards_;
};

// Elementary functions of intervals.

/// The maximal error of a computed function, in units in the last place.
inline constexpr int function_error_ulps = 8;

namespace internal {

template <class F>
Interval increasing(F f, const Interval& a) {
  return Interval::widened(f(a.lower()), f(a.upper()), function_error_ulps);
}

/// The part of a between two numbers; the whole real line if it is empty.
inline Interval part_between(const Interval& a, double lower, double upper) {
  return Interval(std::max(a.lower(), lower), std::min(a.upper(), upper));
}

/// Whether a contains offset + period n for some integer n. Conservative: may be true by mistake, but never false.
inline bool contains_multiple(const Interval& a, double offset, double period) {
  const Interval n = (a - Interval::widened(offset, offset)) / Interval::widened(period, period);
  return std::floor(n.upper()) >= std::ceil(n.lower());
}

} // namespace internal

/// branch_or_kink() of select.h for intervals. Found by argument-dependent lookup.
inline Interval branch_or_kink(const Interval& u, const Interval& v, const Interval& a, const Interval& b, int degree) {
  if (u.lower() > v.upper()) return a;
  if (v.lower() > u.upper()) return b;
  if (degree == 0) return Interval(std::max(u.lower(), v.lower()), std::max(u.upper(), v.upper()));
  return degree == 1 ? Interval::hull(a, b) : Interval::whole();
}

/// @{
/// Contains the values of the function at all numbers in the intervals at which it is defined.
inline Interval abs(const Interval& a) {
  const double p = std::abs(a.lower()), q = std::abs(a.upper());
  return Interval(a.contains(0) ? 0 : std::min(p, q), std::max(p, q));
}

inline Interval max(const Interval& a, const Interval& b) { return branch_or_kink(a, b, a, b, 0); }
inline Interval min(const Interval& a, const Interval& b) { return -max(-a, -b); }

inline Interval sqrt(const Interval& a) {
  if (a.upper() < 0) return Interval::whole();
  const Interval r = Interval::widened(std::sqrt(std::max(a.lower(), 0.0)), std::sqrt(a.upper()));
  return Interval(std::max(r.lower(), 0.0), r.upper());
}

inline Interval cbrt(const Interval& a) {
  return internal::increasing([](double u) { return std::cbrt(u); }, a);
}

inline Interval exp(const Interval& a) {
  const Interval r = internal::increasing([](double u) { return internal::exp_value(u); }, a);
  return Interval(std::max(r.lower(), 0.0), r.upper());
}

inline Interval log(const Interval& a) {
  if (a.upper() <= 0) return Interval::whole();
  return internal::increasing([](double u) { return std::log(u); }, Interval(std::max(a.lower(), 0.0), a.upper()));
}
/// @}

/// a^n, which is monotone in a or, for even n, in |a|. Powers in Jet_3.h call it because repeated squaring would treat
/// the factors as independent numbers.
inline Interval natural_power(const Interval& a, unsigned n) {
  if (n == 0) return Interval(1);
  if (n == 1) return a;
  if (n == 2) return square(a);
  const bool is_even = n % 2 == 0;
  const Interval r = is_even && n <= 8 ? natural_power(square(a), n / 2)
                                       : internal::increasing([n](double u) { return internal::natural_power(u, n); },
                                                              is_even ? abs(a) : a);
  return is_even ? Interval(std::max(r.lower(), 0.0), r.upper()) : r;
}

/// Integer power.
inline Interval pow(const Interval& a, int n) {
  return n < 0 ? Interval(1) / natural_power(a, 0u - unsigned(n)) : natural_power(a, unsigned(n));
}

/// Real power. Bounds the powers of the nonnegative numbers in a, and of the negative ones if b contains an integer.
inline Interval pow(const Interval& a, const Interval& b) {
  const double n = std::floor(b.upper()); // the largest integer that b can contain
  const bool is_whole = b.lower() == n && b.upper() == n && std::abs(n) <= std::numeric_limits<int>::max();
  if (is_whole) return pow(a, int(n));
  return a.lower() < 0 && b.lower() <= n ? Interval::whole() : exp(b * log(a));
}

/// The same for a floating-point exponent, which would be truncated by the integer power.
template <std::floating_point Number>
Interval pow(const Interval& a, Number b) {
  return pow(a, Interval(b));
}

namespace internal {

/// Bounds of a sine wave f with maxima at maximum + 2 pi n.
template <class F>
Interval sine_wave(F f, const Interval& a, double maximum) {
  using std::numbers::pi;
  constexpr double largest = 1e8; // beyond this, the number of periods in a is uncertain
  if (!(std::abs(a.lower()) < largest && std::abs(a.upper()) < largest)) return Interval(-1, 1);
  const double p = f(a.lower()), q = f(a.upper());
  const Interval r = part_between(Interval::widened(std::min(p, q), std::max(p, q), function_error_ulps), -1, 1);
  return Interval(contains_multiple(a, maximum - pi, 2 * pi) ? -1 : r.lower(),
                  contains_multiple(a, maximum, 2 * pi) ? 1 : r.upper());
}

} // namespace internal

/// @{
/// Contains the values of the function at all numbers in the intervals at which it is defined.
inline Interval sin(const Interval& a) {
  return internal::sine_wave([](double u) { return std::sin(u); }, a, std::numbers::pi / 2);
}

inline Interval cos(const Interval& a) {
  return internal::sine_wave([](double u) { return std::cos(u); }, a, 0);
}

inline Interval tan(const Interval& a) {
  using std::numbers::pi;
  if (internal::contains_multiple(a, pi / 2, pi)) return Interval::whole();
  return internal::increasing([](double u) { return std::tan(u); }, a);
}

inline Interval asin(const Interval& a) {
  if (a.lower() > 1 || a.upper() < -1) return Interval::whole();
  return internal::increasing([](double u) { return std::asin(u); }, internal::part_between(a, -1, 1));
}

inline Interval acos(const Interval& a) {
  if (a.lower() > 1 || a.upper() < -1) return Interval::whole();
  return -internal::increasing([](double u) { return -std::acos(u); }, internal::part_between(a, -1, 1));
}

inline Interval atan(const Interval& a) {
  return internal::increasing([](double u) { return std::atan(u); }, a);
}
/// @}

/// factor_for_jump() of select.h for intervals. Derivatives are unbounded if the box meets the jump.
inline Interval factor_for_jump(const Interval& y, const Interval& x) {
  return x.lower() <= 0 && y.contains(0) ? Interval::whole() : Interval(1);
}

/// The angle of (x, y): the whole range if the box meets the cut along the negative x-axis, origin included.
inline Interval atan2(const Interval& y, const Interval& x) {
  using std::numbers::pi;
  if (x.lower() <= 0 && y.contains(0)) return Interval::widened(-pi, pi, function_error_ulps);
  const double angles[4] = {std::atan2(y.lower(), x.lower()), std::atan2(y.lower(), x.upper()),
                            std::atan2(y.upper(), x.lower()), std::atan2(y.upper(), x.upper())};
  return Interval::widened(*std::min_element(angles, angles + 4), *std::max_element(angles, angles + 4),
                           function_error_ulps);
}

/// @{
/// Contains the values of the function at all numbers in the intervals at which it is defined.
inline Interval sinh(const Interval& a) {
  return internal::increasing([](double u) { return std::sinh(u); }, a);
}

inline Interval cosh(const Interval& a) {
  const Interval m = abs(a);
  const Interval r = internal::increasing([](double u) { return std::cosh(u); }, m);
  return Interval(std::max(r.lower(), 1.0), r.upper());
}

inline Interval tanh(const Interval& a) {
  return internal::part_between(internal::increasing([](double u) { return std::tanh(u); }, a), -1, 1);
}

inline Interval hypot(const Interval& x, const Interval& y) {
  const Interval p = abs(x), q = abs(y);
  const Interval r =
      Interval::widened(std::hypot(p.lower(), q.lower()), std::hypot(p.upper(), q.upper()), function_error_ulps);
  return Interval(std::max(r.lower(), 0.0), r.upper());
}

inline Interval hypot(const Interval& x, const Interval& y, const Interval& z) { return hypot(hypot(x, y), z); }
/// @}

/// @{
/// Contains the values of the function at all numbers in the intervals at which it is defined.
inline Interval erf(const Interval& a) {
  return internal::part_between(internal::increasing([](double u) { return std::erf(u); }, a), -1, 1);
}

inline Interval floor(const Interval& a) { return Interval(std::floor(a.lower()), std::floor(a.upper())); }

inline Interval sign(const Interval& a) {
  const auto of_number = [](double u) { return double(u > 0) - double(u < 0); };
  return Interval(of_number(a.lower()), of_number(a.upper()));
}

/// a - n b if the integer part n of a / b is unique; otherwise bounds that follow from the sign of a and from |b|.
inline Interval fmod(const Interval& a, const Interval& b) {
  if (b.lower() == 0 && b.upper() == 0) return Interval::whole();
  const double most = abs(b).upper();
  const Interval bounds(std::max(std::min(a.lower(), 0.0), -most), std::min(std::max(a.upper(), 0.0), most));
  const Interval quotient = a / b;
  const double n = std::trunc(quotient.lower());
  return n == std::trunc(quotient.upper()) && std::isfinite(n) ? Interval::intersection(a - Interval(n) * b, bounds)
                                                               : bounds;
}
/// @}

/// jump_of_remainder() of select.h for intervals.
inline Interval jump_of_remainder(const Interval& a, const Interval& b, const Interval& r) {
  return r.contains(0) && !(abs(a).upper() < abs(b).lower()) ? Interval::whole() : Interval(0);
}

} // namespace equiaffine

/// The limits of an interval are those of double.
/// \cond doxygen does not support members of std
template <>
class std::numeric_limits<equiaffine::Interval> : public std::numeric_limits<double> {
public:
  static constexpr bool is_iec559 = false; ///< an interval is not a hardware type
};
/// \endcond

#endif
