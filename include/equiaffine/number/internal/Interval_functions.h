// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary functions of intervals.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_INTERVAL_FUNCTIONS_H
#define EQUIAFFINE_NUMBER_INTERNAL_INTERVAL_FUNCTIONS_H

#include <equiaffine/number/internal/elementary_functions.h>
#include <equiaffine/number/internal/interval.h>
#include <equiaffine/number/internal/natural_power.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace equiaffine {

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

/// Does for intervals what the function of this name in nonsmooth.h does for numbers. Found there by argument-dependent
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

/// a^n, which is monotone in a or, for even n, in |a|. The powers in Jet_functions_3.h call it, too, since repeated
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

/// Does for intervals what the function of this name in nonsmooth.h does for numbers: derivatives are unbounded if the
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

/// Does for intervals what the function of this name in Jet_steps_3.h does for numbers.
inline Interval jump_of_remainder(const Interval& a, const Interval& b, const Interval& r) {
  return r.contains(0) && !(abs(a).upper() < abs(b).lower()) ? Interval::whole() : Interval(0);
}

} // namespace equiaffine

#endif
