// SPDX-License-Identifier: GPL-3.0-or-later
// The error function, and functions with steps: floor, sign and fmod, of numbers, packs and jets. Intervals have theirs
// in interval.h.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_JET_STEPS_3_H
#define EQUIAFFINE_NUMBER_INTERNAL_JET_STEPS_3_H

#include <equiaffine/number/internal/Jet_functions_3.h>
#include <equiaffine/number/internal/Pack_fwd.h>
#include <equiaffine/number/internal/jet.h>
#include <equiaffine/number/internal/own_steps.h>
#include <equiaffine/number/nonsmooth.h>
#include <equiaffine/number/select.h>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

namespace equiaffine {

/// 1 or -1, the sign of x, or x itself where it is 0 or NaN. Write `using equiaffine::sign; sign(x)`, as the standard
/// library has no such function.
template <std::floating_point T>
T sign(const T& x) {
  return x > T(0) ? T(1) : x < T(0) ? T(-1) : x;
}

/// @{
/// Does in each lane what the function of this name does for T.
template <class T, class Lanes>
Pack<T, Lanes> sign(const Pack<T, Lanes>& a) {
  using P = Pack<T, Lanes>;
  return select(a > P(0), P(1), select(a < P(0), P(-1), a));
}
template <class T, class Lanes>
Pack<T, Lanes> erf(const Pack<T, Lanes>& a) {
  return Pack<T, Lanes>::lane_by_lane(a, [](T u) { return std::erf(u); });
}
template <class T, class Lanes>
Pack<T, Lanes> floor(const Pack<T, Lanes>& a) {
  return Pack<T, Lanes>::lane_by_lane(a, [](T u) { return std::floor(u); });
}
template <class T, class Lanes>
Pack<T, Lanes> fmod(const Pack<T, Lanes>& a, const Pack<T, Lanes>& b) {
  return Pack<T, Lanes>::generate([&](std::size_t i) { return std::fmod(a[i], b[i]); });
}
/// @}

namespace internal {

/// A function with steps: its value, and derivatives that are 0, or NaN where x is at a step. Intervals that contain a
/// step have derivatives that are the whole line.
template <class T, int Order, Monomial_set A>
auto with_steps(const Jet_3<T, Order, A>& a, const T& value, const T& step) {
  const T slope = branch_or_kink(a.value(), step, T(1), T(1), 2) - T(1);
  Jet_3<T, Order, (A | 1)> r;
  r.for_each_monomial([&](auto n) __attribute__((always_inline)) { r.template at<n>() = slope; });
  r.template at<0>() = value;
  return r;
}

} // namespace internal

/// The error function of a jet.
template <class T, int Order, Monomial_set A>
auto erf(const Jet_3<T, Order, A>& a) requires internal::own_steps::HasErf<T> {
  using std::erf;
  using std::exp;
  const T u = a.value(), u2 = u * u;
  const T g = T(exp(T(-u2))) *
              (T(0x1.20dd750429b6dp+0) + T(0x1.1ae3a914fed80p-56)); // 2 / sqrt(pi), which one double does not hold
  const T third = (T(4) * u2 - T(2)) / T(6), fifth = (T(4) * u2 * (T(4) * u2 - T(12)) + T(12)) / T(120);
  return compose(a, std::array<T, 6>{T(erf(u)), g, -u * g, g * third, g * u * (T(3) - T(2) * u2) / T(6), g * fifth});
}

/// The largest whole number that is not greater than the value of a jet. Derivatives are 0, and NaN at whole numbers.
template <class T, int Order, Monomial_set A>
auto floor(const Jet_3<T, Order, A>& a) requires internal::own_steps::HasFloor<T> {
  using std::floor;
  const T value = floor(a.value());
  return internal::with_steps(a, value, value);
}

/// The sign of the value of a jet, 1, 0 or -1. Derivatives are 0, and NaN where the value is 0.
template <class T, int Order, Monomial_set A>
auto sign(const Jet_3<T, Order, A>& a) requires requires(const T& x) {
  { sign(x) } -> std::convertible_to<T>;
}
{ return internal::with_steps(a, T(sign(a.value())), T(0)); }

/// The remainder of a / b, a - n b for a whole number n, with the sign of a. Where n changes, derivatives are NaN.
template <class T, int Order, Monomial_set A, Monomial_set B>
auto fmod(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) requires internal::own_steps::HasFmod<T> {
  using std::fmod;
  const T value = fmod(a.value(), b.value()), n = (a.value() - value) / b.value();
  const T jump = jump_of_remainder(a.value(), b.value(), value);
  auto r = a - b * n;
  r.for_each_monomial([&](auto m) __attribute__((always_inline)) { r.template at<m>() = r.template at<m>() + jump; });
  r.template at<0>() = value;
  return r;
}

/// @{
/// The same where one of them is a number.
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto fmod(const Jet_3<T, Order, A>& a, const S& b) requires internal::own_steps::HasFmod<T> {
  return fmod(a, Jet_3<T, Order, 1>(T(b)));
}
template <class T, int Order, Monomial_set B, JetScalar<T> S>
auto fmod(const S& a, const Jet_3<T, Order, B>& b) requires internal::own_steps::HasFmod<T> {
  return fmod(Jet_3<T, Order, 1>(T(a)), b);
}
/// @}

} // namespace equiaffine

#endif
