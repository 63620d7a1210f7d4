// SPDX-License-Identifier: GPL-3.0-or-later
// Interval, closed intervals of reals with outward rounding, with its elementary functions.
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

/// Thrown by a comparison of intervals whose answer depends on the numbers in them. Who asked for bounds has to do
/// without.
struct Undecided_comparison : std::exception {
  /// The message of the exception.
  const char* what() const noexcept override { return "a comparison of intervals is undecided"; }
};

/// A closed interval of reals [lower, upper] with outward rounded arithmetic: the result of a function of intervals
/// contains its values at all points of them (Moore, Kearfott, Cloud: Introduction to Interval Analysis, 2009).
///
/// Rounding is by widening each computed bound, never by switching the rounding mode of the processor: results do not
/// depend on compiler flags, threads keep their modes, and clang and vectorization are safe. Sums, products, quotients
/// and square roots are widened by one unit in the last place, other functions by eight (for exp less than 1 would do,
/// glibc documents at most 3 for the others). A thread that rounds downwards or towards zero sees no overflow.
///
/// A bound that is NaN, and a function evaluated partly outside its domain, give the whole line where the result is
/// unknown; sqrt, log and the like use the part of the argument inside the domain, as is usual, and the whole line if
/// there is none.
class Interval {
  using Limits = std::numeric_limits<double>;

public:
  Interval() = default; ///< leaves the bounds uninitialized

  /// The interval that contains a number alone, or, where a double cannot hold that, the numbers beside it. Infinity
  /// and NaN give what the constructor from two bounds does.
  template <class Number>
  Interval(Number value) requires(std::is_arithmetic_v<Number>) : outwards_{-double(value), double(value)} {
    const double x = double(value);
    if (!std::isfinite(x)) *this = Interval(x, x);
    if constexpr (std::numeric_limits<Number>::digits > Limits::digits)
      if (value == value && static_cast<long double>(x) != static_cast<long double>(value)) *this = widened(x, x);
  }

  /// The interval from `lower` to `upper`; a lower bound of +infinity becomes the largest number, an upper one of
  /// -infinity the lowest. Unless lower <= upper, as with a NaN, it is the whole line.
  Interval(double lower, double upper)
      : Interval(lower <= upper ? greater(Outwards{-lower, upper}, repeated(Limits::lowest()))
                                : repeated(Limits::infinity())) {}

  static Interval whole() { return repeated(Limits::infinity()); } ///< all reals

  double lower() const { return -outwards_[0]; }                         ///< the lower bound
  double upper() const { return outwards_[1]; }                          ///< the upper bound
  bool contains(double x) const { return lower() <= x && x <= upper(); } ///< whether a number lies in it

  Interval operator-() const { return swapped(outwards_); } ///< the opposite numbers
  Interval operator+() const { return *this; }              ///< the same interval

  /// @{
  /// Outward rounded arithmetic.
  friend Interval operator+(const Interval& a, const Interval& b) { return rounded(a.outwards_ + b.outwards_); }
  friend Interval operator-(const Interval& a, const Interval& b) {
    return rounded(a.outwards_ + swapped(b.outwards_));
  }
  /// An interval times itself is a square: never negative.
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
  /// Code with branches works for intervals on which the branches do not meet: a comparison has the answer that it has
  /// for every pair of numbers. \throw Undecided_comparison if it is not the same for all
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

  /// The squares of the numbers of an interval.
  friend Interval square(const Interval& a) {
    const Outwards s = swapped(a.outwards_);
    const double least = std::max(-lesser(a.outwards_, s)[0], 0.0), largest = greater(a.outwards_, s)[0]; // of |a|
    const Outwards squares = Outwards{least, largest} * Outwards{-least, largest};
    if (largest >= smallest_normal_root && (least == 0 || least >= smallest_normal_root)) return rounded(squares);
    if (largest == 0) return a;
    const Interval r = widened(squares, 1);
    return Interval(std::max(r.lower(), 0.0), r.upper());
  }

  /// [lower, upper] widened by `ulps` units in the last place on each side, and by the smallest normal number. A bound
  /// that overflowed inwards is replaced by the largest number.
  static Interval widened(double lower, double upper, int ulps = 1) {
    return lower <= upper ? widened(Outwards{-lower, upper}, ulps) : whole();
  }

  /// The smallest interval that contains both.
  static Interval hull(const Interval& a, const Interval& b) { return greater(a.outwards_, b.outwards_); }

  /// The intersection of two bounds of the same number; the whole line if they have no point in common.
  static Interval intersection(const Interval& a, const Interval& b) {
    const Interval r = lesser(a.outwards_, b.outwards_);
    return r.lower() <= r.upper() ? r : whole();
  }

private:
  /// The pair (-lower, upper): both numbers grow outwards, and neither is NaN or -infinity.
  typedef double Outwards __attribute__((vector_size(2 * sizeof(double))));

  /// A product below the first number may have been rounded to a subnormal one, and so may the square of a number below
  /// the second.
  static constexpr double smallest_normal = Limits::min() / Limits::epsilon(), smallest_normal_root = 0x1p-485;

  Interval(const Outwards& outwards) : outwards_(outwards) {}

  static Outwards repeated(double x) { return Outwards{x, x}; }
  static Outwards swapped(const Outwards& x) { return __builtin_shufflevector(x, x, 1, 0); }

  // Both return the second argument where only the first is NaN. From the conditional expressions GCC would make three
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

  /// Widens bounds that are exact where they are subnormal, as sums are: not by the smallest normal number, too. A
  /// subnormal number, once made, would slow down all that is computed of it.
  static Interval rounded(const Outwards& outwards, int ulps = 1) {
    const Outwards x = greater(outwards, repeated(Limits::lowest()));
    return greater(x * (1 + Limits::epsilon() * ulps), x * (1 - Limits::epsilon() * ulps));
  }

  /// The product where a factor is zero, infinite, or so small that a product of bounds may be subnormal.
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

  // An infinite bound is approached, never reached: 0 times it is 0, and anything divided by it tends to 0.
  static double product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }
  static double quotient(double a, double b) { return std::isinf(b) ? 0 : a / b; }

  Outwards outwards_;
};

// Elementary functions of intervals.

/// The greatest error of a computed function, in units in the last place.
inline constexpr int function_error_ulps = 8;

namespace internal {

template <class F>
Interval increasing(F f, const Interval& a) {
  return Interval::widened(f(a.lower()), f(a.upper()), function_error_ulps);
}

/// The part of interval a between two numbers, or the whole line if there is none.
inline Interval part_between(const Interval& a, double lower, double upper) {
  return Interval(std::max(a.lower(), lower), std::min(a.upper(), upper));
}

/// Whether interval a contains offset + period n for an integer n. It may be true by mistake, but never false.
inline bool contains_multiple(const Interval& a, double offset, double period) {
  const Interval n = (a - Interval::widened(offset, offset)) / Interval::widened(period, period);
  return std::floor(n.upper()) >= std::ceil(n.lower());
}

} // namespace internal

/// Does for intervals what the function of this name in select.h does for numbers. Found there by argument-dependent
/// lookup.
inline Interval branch_or_kink(const Interval& u, const Interval& v, const Interval& a, const Interval& b, int degree) {
  if (u.lower() > v.upper()) return a;
  if (v.lower() > u.upper()) return b;
  if (degree == 0) return Interval(std::max(u.lower(), v.lower()), std::max(u.upper(), v.upper()));
  return degree == 1 ? Interval::hull(a, b) : Interval::whole();
}

/// @{
/// Contains the values of the function of this name at the numbers of the intervals where it is defined.
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

/// a^n, which is monotone in a or, for even n, in |a|. The powers in Jet_3.h call it, too, since repeated
/// squaring would treat the factors as independent numbers.
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

/// Real power. It bounds the powers of the numbers in a that are not negative, and of the others where b contains a
/// whole number.
inline Interval pow(const Interval& a, const Interval& b) {
  const double n = std::floor(b.upper()); // the largest whole number that b can contain
  const bool is_whole = b.lower() == n && b.upper() == n && std::abs(n) <= std::numeric_limits<int>::max();
  if (is_whole) return pow(a, int(n));
  return a.lower() < 0 && b.lower() <= n ? Interval::whole() : exp(b * log(a));
}

/// The same for an exponent that would lose its fraction as an argument of the integer power.
template <std::floating_point Number>
Interval pow(const Interval& a, Number b) {
  return pow(a, Interval(b));
}

namespace internal {

/// Bounds of a sine wave f, whose maxima lie at maximum + 2 pi n.
template <class F>
Interval sine_wave(F f, const Interval& a, double maximum) {
  using std::numbers::pi;
  constexpr double largest = 1e8; // larger arguments do not tell for certain how many periods a has
  if (!(std::abs(a.lower()) < largest && std::abs(a.upper()) < largest)) return Interval(-1, 1);
  const double p = f(a.lower()), q = f(a.upper());
  const Interval r = part_between(Interval::widened(std::min(p, q), std::max(p, q), function_error_ulps), -1, 1);
  return Interval(contains_multiple(a, maximum - pi, 2 * pi) ? -1 : r.lower(),
                  contains_multiple(a, maximum, 2 * pi) ? 1 : r.upper());
}

} // namespace internal

/// @{
/// Contains the values of the function of this name at the numbers of the intervals where it is defined.
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

/// Does for intervals what the function of this name in select.h does for numbers: derivatives are unbounded if the
/// box meets the jump.
inline Interval factor_for_jump(const Interval& y, const Interval& x) {
  return x.lower() <= 0 && y.contains(0) ? Interval::whole() : Interval(1);
}

/// The angle of (x, y): the whole range where the box contains the origin or meets the cut along the negative x-axis.
inline Interval atan2(const Interval& y, const Interval& x) {
  using std::numbers::pi;
  if (x.lower() <= 0 && y.contains(0)) return Interval::widened(-pi, pi, function_error_ulps);
  const double angles[4] = {std::atan2(y.lower(), x.lower()), std::atan2(y.lower(), x.upper()),
                            std::atan2(y.upper(), x.lower()), std::atan2(y.upper(), x.upper())};
  return Interval::widened(*std::min_element(angles, angles + 4), *std::max_element(angles, angles + 4),
                           function_error_ulps);
}

/// @{
/// Contains the values of the function of this name at the numbers of the intervals where it is defined.
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
/// Contains the values of the function of this name at the numbers of the intervals where it is defined.
inline Interval erf(const Interval& a) {
  return internal::part_between(internal::increasing([](double u) { return std::erf(u); }, a), -1, 1);
}

inline Interval floor(const Interval& a) { return Interval(std::floor(a.lower()), std::floor(a.upper())); }

inline Interval sign(const Interval& a) {
  const auto of_number = [](double u) { return double(u > 0) - double(u < 0); };
  return Interval(of_number(a.lower()), of_number(a.upper()));
}

/// Where the quotient has one whole part n it is a - n b, else it has the sign of a and is less than b.
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

/// Does for intervals what the function of this name in Jet_3.h does for numbers.
inline Interval jump_of_remainder(const Interval& a, const Interval& b, const Interval& r) {
  return r.contains(0) && !(abs(a).upper() < abs(b).lower()) ? Interval::whole() : Interval(0);
}

} // namespace equiaffine

/// The limits of an interval are those of doubles, which convert to intervals.
/// \cond doxygen knows no members of std
template <>
class std::numeric_limits<equiaffine::Interval> : public std::numeric_limits<double> {
public:
  static constexpr bool is_iec559 = false; ///< an interval is no number of the processor
};
/// \endcond

#endif
