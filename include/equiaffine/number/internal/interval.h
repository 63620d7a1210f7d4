// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_NUMBER_INTERNAL_INTERVAL_H
#define EQUIAFFINE_NUMBER_INTERNAL_INTERVAL_H

#include <equiaffine/base/internal/check_flags.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace equiaffine {

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

} // namespace equiaffine

#endif
