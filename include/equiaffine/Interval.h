// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERVAL_H
#define EQUIAFFINE_INTERVAL_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

namespace equiaffine {

/// A closed interval of reals [lower, upper] with outward rounded arithmetic: the result of a function of intervals
/// contains its values at all points of them (Moore, Kearfott, Cloud: Introduction to Interval Analysis, 2009).
///
/// Rounding is by widening each computed bound, never by switching the rounding mode of the processor: results do not
/// depend on compiler flags, threads keep their modes, and clang and vectorisation are safe. Sums, products, quotients
/// and square roots are widened by one unit in the last place, functions of the C library by eight (glibc documents
/// at most 3).
///
/// A bound that is NaN, and a function evaluated partly outside its domain, give the whole line where the result is
/// unknown; sqrt, log and the like use the part of the argument inside the domain, as is usual, and the whole line if
/// there is none.
class Interval {
public:
  Interval() = default;

  template <class Number>
  Interval(Number value) requires(std::is_arithmetic_v<Number>) : Interval(double(value), double(value)) {
    if constexpr (std::numeric_limits<Number>::digits > std::numeric_limits<double>::digits)
      if (static_cast<long double>(lower_) != static_cast<long double>(value)) *this = widened(lower_, upper_);
  }

  /// The hull of two numbers with lower <= upper; anything else (NaN included) is the whole line.
  Interval(double lower, double upper) : lower_(lower), upper_(upper) {
    if (!(lower <= upper)) *this = whole();
  }

  static Interval whole() {
    Interval r;
    r.lower_ = -std::numeric_limits<double>::infinity();
    r.upper_ = std::numeric_limits<double>::infinity();
    return r;
  }

  double lower() const { return lower_; }
  double upper() const { return upper_; }
  bool contains(double x) const { return lower_ <= x && x <= upper_; }

  Interval operator-() const { return Interval(-upper_, -lower_); }
  Interval operator+() const { return *this; }

  friend Interval operator+(const Interval& a, const Interval& b) {
    return rounded(a.lower_ + b.lower_, a.upper_ + b.upper_);
  }
  friend Interval operator-(const Interval& a, const Interval& b) {
    return rounded(a.lower_ - b.upper_, a.upper_ - b.lower_);
  }
  /// An interval times itself is a square: never negative.
  friend Interval operator*(const Interval& a, const Interval& b) {
    if (&a == &b) return square(a);
    const double p = a.lower_ * b.lower_, q = a.lower_ * b.upper_, r = a.upper_ * b.lower_, s = a.upper_ * b.upper_;
    if (!(is_normal(p) && is_normal(q) && is_normal(r) && is_normal(s))) return special_product(a, b);
    return rounded(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
  }
  friend Interval operator/(const Interval& a, const Interval& b) {
    if (b.lower_ <= 0 && b.upper_ >= 0) return whole();
    const double p = quotient(a.lower_, b.lower_), q = quotient(a.lower_, b.upper_);
    const double r = quotient(a.upper_, b.lower_), s = quotient(a.upper_, b.upper_);
    return widened(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
  }
  Interval& operator+=(const Interval& b) { return *this = *this + b; }
  Interval& operator-=(const Interval& b) { return *this = *this - b; }
  Interval& operator*=(const Interval& b) { return *this = *this * b; }
  Interval& operator/=(const Interval& b) { return *this = *this / b; }

  friend bool operator==(const Interval&, const Interval&) = default;

  friend Interval square(const Interval& a) {
    const double p = a.lower_ * a.lower_, q = a.upper_ * a.upper_;
    const double lower = a.contains(0) ? 0 : std::min(p, q), upper = std::max(p, q);
    if (is_normal(p) && is_normal(q)) return rounded(lower, upper);
    if (a.lower_ == 0 && a.upper_ == 0) return a;
    const Interval r = widened(lower, upper);
    return Interval(std::max(r.lower_, 0.0), r.upper_);
  }

  /// [lower, upper] widened by `ulps` units in the last place on each side, and by the smallest number. A bound that
  /// overflowed inwards is replaced by the largest number.
  static Interval widened(double lower, double upper, int ulps = 1) {
    constexpr double tiny = Limits::denorm_min();
    const Interval r = rounded(lower, upper, ulps);
    return Interval(r.lower_ - tiny, r.upper_ + tiny);
  }

  /// The smallest interval that contains both.
  static Interval hull(const Interval& a, const Interval& b) {
    return Interval(std::min(a.lower_, b.lower_), std::max(a.upper_, b.upper_));
  }

  /// What both contain; two bounds of the same number have something in common.
  static Interval intersection(const Interval& a, const Interval& b) {
    return Interval(std::max(a.lower_, b.lower_), std::min(a.upper_, b.upper_));
  }

private:
  using Limits = std::numeric_limits<double>;

  /// Not so small that rounding may have been that of subnormal numbers, and not NaN.
  static bool is_normal(double x) { return std::abs(x) >= Limits::min() / Limits::epsilon(); }

  /// Like widened() for bounds that are exact where they are subnormal: sums are. A subnormal number, once made, would
  /// slow down all that is computed of it.
  static Interval rounded(double lower, double upper, int ulps = 1) {
    lower = std::min(lower, Limits::max());
    upper = std::max(upper, Limits::lowest());
    return Interval(lower - std::abs(lower) * (Limits::epsilon() * ulps),
                    upper + std::abs(upper) * (Limits::epsilon() * ulps));
  }

  /// Where a factor is zero, infinite, or so small that a product may be subnormal.
  static Interval special_product(const Interval& a, const Interval& b) {
    if ((a.lower_ == 0 && a.upper_ == 0) || (b.lower_ == 0 && b.upper_ == 0)) return Interval(0.0, 0.0);
    double lower = Limits::infinity(), upper = -Limits::infinity();
    bool is_exact_if_small = true;
    for (const double x : {a.lower_, a.upper_})
      for (const double y : {b.lower_, b.upper_}) {
        const double p = product(x, y);
        lower = std::min(lower, p);
        upper = std::max(upper, p);
        is_exact_if_small = is_exact_if_small && (x == 0 || y == 0 || is_normal(p));
      }
    return is_exact_if_small ? rounded(lower, upper) : widened(lower, upper);
  }

  // An infinite bound is approached, never reached: 0 times it is 0, and anything divided by it tends to 0.
  static double product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }
  static double quotient(double a, double b) { return std::isinf(b) ? 0 : a / b; }

  double lower_, upper_;
};

/// How far a function of the C library may be from the true value, in units in the last place.
inline constexpr int library_error_ulps = 8;

namespace internal {

template <class F>
Interval increasing(F f, const Interval& a) {
  return Interval::widened(f(a.lower()), f(a.upper()), library_error_ulps);
}

/// The part of a between two numbers; the whole line if there is none.
inline Interval clamped(const Interval& a, double lower, double upper) {
  return Interval(std::max(a.lower(), lower), std::min(a.upper(), upper));
}

/// Whether a contains offset + period n for an integer n; errs on the side of true.
inline bool contains_multiple(const Interval& a, double offset, double period) {
  const Interval n = (a - Interval::widened(offset, offset)) / Interval::widened(period, period);
  return std::floor(n.upper()) >= std::ceil(n.lower());
}

} // namespace internal

/// The hook of internal/kinks.h, found by argument-dependent lookup.
inline Interval branch_or_kink(const Interval& u, const Interval& v, const Interval& a, const Interval& b, int degree) {
  if (u.lower() > v.upper()) return a;
  if (v.lower() > u.upper()) return b;
  if (degree == 0) return Interval(std::max(u.lower(), v.lower()), std::max(u.upper(), v.upper()));
  return degree == 1 ? Interval::hull(a, b) : Interval::whole();
}

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
  const Interval r = internal::increasing([](double u) { return std::exp(u); }, a);
  return Interval(std::max(r.lower(), 0.0), r.upper());
}

inline Interval log(const Interval& a) {
  if (a.upper() <= 0) return Interval::whole();
  return internal::increasing([](double u) { return std::log(u); }, Interval(std::max(a.lower(), 0.0), a.upper()));
}

/// a^n, monotone in a or, for even n, in |a|. It also is the hook for the powers in Jet_functions_3.h, where repeated
/// squaring would take the factors for independent.
inline Interval natural_power(const Interval& a, unsigned n) {
  if (n == 0) return Interval(1);
  if (n == 1) return a;
  if (n == 2) return square(a);
  if (n % 2 == 1) return internal::increasing([n](double u) { return std::pow(u, n); }, a);
  const Interval m = abs(a);
  const Interval r = internal::increasing([n](double u) { return std::pow(u, n); }, m);
  return Interval(std::max(r.lower(), 0.0), r.upper());
}

/// Integer power.
inline Interval pow(const Interval& a, int n) {
  return n < 0 ? Interval(1) / natural_power(a, 0u - unsigned(n)) : natural_power(a, unsigned(n));
}

/// Real power: of the part of a that is not negative, and of the rest where b contains a whole number.
inline Interval pow(const Interval& a, const Interval& b) {
  const double n = std::floor(b.upper()); // the largest whole number that b can contain
  const bool is_whole = b.lower() == n && b.upper() == n && std::abs(n) <= std::numeric_limits<int>::max();
  if (is_whole) return pow(a, int(n));
  return a.lower() < 0 && b.lower() <= n ? Interval::whole() : exp(b * log(a));
}

namespace internal {

/// Bounds of a sine wave f, whose maxima lie at maximum + 2 pi n.
template <class F>
Interval sine_wave(F f, const Interval& a, double maximum) {
  using std::numbers::pi;
  constexpr double largest = 1e8; // beyond, whole periods are not told apart with certainty
  if (!(std::abs(a.lower()) < largest && std::abs(a.upper()) < largest)) return Interval(-1, 1);
  const double p = f(a.lower()), q = f(a.upper());
  const Interval r = clamped(Interval::widened(std::min(p, q), std::max(p, q), library_error_ulps), -1, 1);
  return Interval(contains_multiple(a, maximum - pi, 2 * pi) ? -1 : r.lower(),
                  contains_multiple(a, maximum, 2 * pi) ? 1 : r.upper());
}

} // namespace internal

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
  return internal::increasing([](double u) { return std::asin(u); }, internal::clamped(a, -1, 1));
}

inline Interval acos(const Interval& a) {
  if (a.lower() > 1 || a.upper() < -1) return Interval::whole();
  return -internal::increasing([](double u) { return -std::acos(u); }, internal::clamped(a, -1, 1));
}

inline Interval atan(const Interval& a) {
  return internal::increasing([](double u) { return std::atan(u); }, a);
}

/// The angle of (x, y): the whole range where the box contains the origin or meets the cut along the negative x-axis.
inline Interval atan2(const Interval& y, const Interval& x) {
  using std::numbers::pi;
  if (x.lower() <= 0 && y.contains(0)) return Interval::widened(-pi, pi, library_error_ulps);
  const double angles[4] = {std::atan2(y.lower(), x.lower()), std::atan2(y.lower(), x.upper()),
                            std::atan2(y.upper(), x.lower()), std::atan2(y.upper(), x.upper())};
  return Interval::widened(*std::min_element(angles, angles + 4), *std::max_element(angles, angles + 4),
                           library_error_ulps);
}

inline Interval sinh(const Interval& a) {
  return internal::increasing([](double u) { return std::sinh(u); }, a);
}

inline Interval cosh(const Interval& a) {
  const Interval m = abs(a);
  const Interval r = internal::increasing([](double u) { return std::cosh(u); }, m);
  return Interval(std::max(r.lower(), 1.0), r.upper());
}

inline Interval tanh(const Interval& a) {
  return internal::clamped(internal::increasing([](double u) { return std::tanh(u); }, a), -1, 1);
}

inline Interval hypot(const Interval& x, const Interval& y) {
  const Interval p = abs(x), q = abs(y);
  const Interval r =
      Interval::widened(std::hypot(p.lower(), q.lower()), std::hypot(p.upper(), q.upper()), library_error_ulps);
  return Interval(std::max(r.lower(), 0.0), r.upper());
}

} // namespace equiaffine

#endif
