// SPDX-License-Identifier: GPL-3.0-or-later
// Jet_3, Taylor polynomials in three variables, with powers, elementary functions, comparisons and step functions.
#ifndef EQUIAFFINE_NUMBER_JET_3_H
#define EQUIAFFINE_NUMBER_JET_3_H

#include <equiaffine/number/internal/elementary_functions.h>
#include <equiaffine/number/internal/jet.h> // IWYU pragma: export
#include <equiaffine/number/select.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>

namespace equiaffine::internal {

/// a^p, given its value. Powers and logarithms are composed from a / a_0, which is close to 1 at any scale of a; powers
/// of a_0 itself would overflow.
template <class T, int Order, Monomial_set A>
auto real_power(const Jet_3<T, Order, A>& a, const T& value, const T& p) {
  std::array<T, 6> t = {value, T(0), T(0), T(0), T(0), T(0)}; // (p choose k) value
  for (int k = 1; k <= Order; ++k) t[std::size_t(k)] = t[std::size_t(k - 1)] * (p - T(k - 1)) / T(k);
  return compose(a * T(T(1) / a.value()), t);
}

/// Whether all coefficients are zero; false for packs.
template <class T, int Order, Monomial_set A>
bool is_zero(const Jet_3<T, Order, A>& a) {
  if constexpr (requires(const T& x) {
                  { x == T(0) } -> std::convertible_to<bool>;
                }) {
    return std::all_of(a.coefficients().begin(), a.coefficients().end(), [](const T& x) { return x == T(0); });
  } else {
    return false;
  }
}

/// exp(a), given exp(a_0).
template <class T, int Order, Monomial_set A>
auto exponential(const Jet_3<T, Order, A>& a, const T& e) {
  return compose(a, std::array<T, 6>{T(1), T(1), T(0.5), fraction<1, 6, T>(), fraction<1, 24, T>(),
                                     fraction<1, 120, T>()}) *
         e;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// @{
/// The expansion of a composed function, given the expansions of its arguments.
template <class T, int Order, Monomial_set A>
auto exp(const Jet_3<T, Order, A>& a) {
  return internal::exponential(a, internal::exp_value(a.value()));
}

/// The natural logarithm.
template <class T, int Order, Monomial_set A>
auto log(const Jet_3<T, Order, A>& a) {
  using std::log;
  const T l = log(a.value());
  const T one = T(1) + T(0) * l; // NaN where l is not finite, although 1 / a_0 may be finite
  return compose(a * T(T(1) / a.value()), std::array<T, 6>{l, one, one * T(-0.5), one * fraction<1, 3, T>(),
                                                           one * T(-0.25), one * fraction<1, 5, T>()});
}

/// The square root. s is computed from a = s^2 degree by degree: 2 s_0 s_n = a_n - (products of lower parts).
template <class T, int Order, Monomial_set A>
auto sqrt(const Jet_3<T, Order, A>& a) {
  using std::sqrt;
  const T s0 = sqrt(a.value()), half = T(0.5) / s0;
  const auto s1 = internal::homogeneous_part<1>(a) * half;
  const auto s1_twice = s1 + s1;
  const auto s2 = (internal::homogeneous_part<2>(a) - square(s1)) * half;
  const auto s3 = (internal::homogeneous_part<3>(a) - s1_twice * s2) * half;
  const auto s4 = (internal::homogeneous_part<4>(a) - (s1_twice * s3 + square(s2))) * half;
  using Result = Jet_3<T, Order, internal::closure(A & ~Monomial_set(1), Order)>;
  if constexpr (Order < 5) return Result(Jet_3<T, Order, 1>(s0) + s1 + s2 + s3 + s4);
  else
    return Result(Jet_3<T, Order, 1>(s0) + s1 + s2 + s3 + s4 +
                  (internal::homogeneous_part<5>(a) - (s1_twice * s4 + (s2 + s2) * s3)) * half);
}

/// The cube root.
template <class T, int Order, Monomial_set A>
auto cbrt(const Jet_3<T, Order, A>& a) {
  using std::cbrt;
  return internal::real_power(a, T(cbrt(a.value())), T(T(1) / T(3)));
}

/// Integer power. The value of the jet may be zero if n >= 0.
template <class T, int Order, Monomial_set A>
auto pow(const Jet_3<T, Order, A>& a, int n) -> decltype(compose(a, std::array<T, 6>())) {
  using internal::natural_power;
  if (n < 0) return internal::real_power(a, T(T(1) / natural_power(a.value(), 0u - unsigned(n))), T(n));
  if (n == 2) return square(a);
  std::array<T, 6> t;
  t.fill(T(0));
  T binomial(1); // (n choose k)
  for (int k = 0; k <= Order; ++k) {
    t[std::size_t(k)] = k > n ? T(0) : T(binomial * natural_power(a.value(), unsigned(n - k)));
    binomial = binomial * (T(n) - T(k)) / T(k + 1);
  }
  return compose(a, t);
}

/// Real power; integer exponents use the integer power.
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto pow(const Jet_3<T, Order, A>& a, const S& exponent) requires(!std::is_integral_v<S>) {
  using std::pow;
  if constexpr (std::is_floating_point_v<S>)
    if (std::abs(exponent) <= S(std::numeric_limits<short>::max()) && exponent == std::trunc(exponent))
      return pow(a, int(exponent));
  return internal::real_power(a, T(pow(a.value(), T(exponent))), T(exponent));
}

/// A power with a variable exponent: exp(b log(a)), and zero where a is zero and b is positive.
template <class T, int Order, Monomial_set A, Monomial_set B>
auto pow(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {
  using std::log;
  using std::pow;
  using Exponent = decltype(b * log(a));
  const auto zero = [&] { // NaN where b is not positive and 0^b is not defined
    const T logarithm = log(b.value());
    return T(logarithm - logarithm);
  };
  const Exponent exponent = internal::is_zero(a) ? Exponent(b * zero()) : b * log(a);
  return internal::exponential(exponent, T(pow(a.value(), b.value())));
}

/// The same for a constant base.
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto pow(const S& base, const Jet_3<T, Order, A>& exponent) {
  using std::log;
  using std::pow;
  return internal::exponential(exponent * T(log(T(base))), T(pow(T(base), exponent.value())));
}
/// @}

// Comparisons, max, min, abs, and numeric limits of jets.

#define EQUIAFFINE_JET_COMPARISON(op)                                                                                  \
  /** Jets compare by their values, so that functions may branch. */                                                   \
  template <class T, int Order, Monomial_set A, Monomial_set B>                                                        \
  auto operator op(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {                                         \
    return a.value() op b.value();                                                                                     \
  }                                                                                                                    \
  /** Jets compare by their values, so that functions may branch. */                                                   \
  template <class T, int Order, Monomial_set A, JetScalar<T> S>                                                        \
  auto operator op(const Jet_3<T, Order, A>& a, const S& s) {                                                          \
    return a.value() op T(s);                                                                                          \
  }                                                                                                                    \
  /** Jets compare by their values, so that functions may branch. */                                                   \
  template <class T, int Order, Monomial_set A, JetScalar<T> S>                                                        \
  auto operator op(const S& s, const Jet_3<T, Order, A>& a) {                                                          \
    return T(s) op a.value();                                                                                          \
  }
EQUIAFFINE_JET_COMPARISON(<)
EQUIAFFINE_JET_COMPARISON(>)
EQUIAFFINE_JET_COMPARISON(<=)
EQUIAFFINE_JET_COMPARISON(>=)
#undef EQUIAFFINE_JET_COMPARISON

/// The larger of two functions. Where they are equal, the value is correct and the derivatives are NaN. For intervals
/// that overlap, first derivatives are the hull of both, and higher ones are the whole real line.
template <class T, int Order, Monomial_set A, Monomial_set B>
auto max(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {
  Jet_3<T, Order, (A | B | 1)> r;
  r.for_each_monomial([&](auto n) __attribute__((always_inline)) {
    constexpr int degree = internal::monomials[std::size_t(n())].degree();
    r.template at<n>() = branch_or_kink(a.value(), b.value(), a.template coefficient_or_zero<n>(),
                                        b.template coefficient_or_zero<n>(), degree);
  });
  return r;
}

/// |a|, the larger of a and -a.
template <class T, int Order, Monomial_set A>
auto abs(const Jet_3<T, Order, A>& a) {
  using std::abs;
  auto r = max(a, -a);
  r.template at<0>() = abs(a.value());
  return r;
}

/// The smaller of two functions, with derivatives like those of max().
template <class T, int Order, Monomial_set A, Monomial_set B>
auto min(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {
  return -max(-a, -b);
}

/// @{
/// Overloads for equal types: after `using std::max`, std::max and std::min would otherwise be ambiguous.
template <class T, int Order, Monomial_set A>
auto max(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, A>& b) {
  return max<T, Order, A, A>(a, b);
}
template <class T, int Order, Monomial_set A>
auto min(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, A>& b) {
  return min<T, Order, A, A>(a, b);
}
/// @}

} // namespace equiaffine

/// \cond doxygen does not support members of std
/// The limits of a jet are those of its coefficients.
template <class T, int Order, equiaffine::Monomial_set Support>
class std::numeric_limits<equiaffine::Jet_3<T, Order, Support>> : public std::numeric_limits<T> {
public:
  static constexpr bool is_iec559 = false; ///< a jet is not a hardware type
};
/// \endcond

namespace equiaffine {

// Trigonometric and hyperbolic functions, their inverses, atan2 and hypot.

/// The sine of a jet.
template <class T, int Order, Monomial_set A>
auto sin(const Jet_3<T, Order, A>& a) {
  using internal::sine_and_cosine;
  const auto [s, c] = sine_and_cosine(a.value());
  return compose(a, std::array<T, 6>{s, c, s * T(-0.5), c * fraction<-1, 6, T>(), s * fraction<1, 24, T>(),
                                     c * fraction<1, 120, T>()});
}

/// The cosine of a jet.
template <class T, int Order, Monomial_set A>
auto cos(const Jet_3<T, Order, A>& a) {
  using internal::sine_and_cosine;
  const auto [s, c] = sine_and_cosine(a.value());
  return compose(a, std::array<T, 6>{c, -s, c * T(-0.5), s * fraction<1, 6, T>(), c * fraction<1, 24, T>(),
                                     s * fraction<-1, 120, T>()});
}

/// The tangent of a jet.
template <class T, int Order, Monomial_set A>
auto tan(const Jet_3<T, Order, A>& a) {
  using std::tan;
  const T t = tan(a.value()), t2 = t * t, d = T(1) + t2;
  return compose(a, std::array<T, 6>{t, d, t * d, d * (T(1) + T(3) * t2) / T(3), t * d * (T(2) + T(3) * t2) / T(3),
                                     d * (T(2) + T(15) * (t2 + t2 * t2)) / T(15)});
}

/// The hyperbolic sine of a jet.
template <class T, int Order, Monomial_set A>
auto sinh(const Jet_3<T, Order, A>& a) {
  using std::cosh;
  using std::sinh;
  const T s = sinh(a.value()), c = cosh(a.value());
  return compose(a, std::array<T, 6>{s, c, s * T(0.5), c * fraction<1, 6, T>(), s * fraction<1, 24, T>(),
                                     c * fraction<1, 120, T>()});
}

/// The hyperbolic cosine of a jet.
template <class T, int Order, Monomial_set A>
auto cosh(const Jet_3<T, Order, A>& a) {
  using std::cosh;
  using std::sinh;
  const T s = sinh(a.value()), c = cosh(a.value());
  return compose(a, std::array<T, 6>{c, s, c * T(0.5), s * fraction<1, 6, T>(), c * fraction<1, 24, T>(),
                                     s * fraction<1, 120, T>()});
}

/// The hyperbolic tangent of a jet, with tanh' = 1 / cosh^2: 1 - tanh^2 would lose all digits for large arguments.
template <class T, int Order, Monomial_set A>
auto tanh(const Jet_3<T, Order, A>& a) {
  using std::cosh;
  using std::tanh;
  const T t = tanh(a.value()), t2 = t * t, r = T(1) / cosh(a.value()), d = r * r;
  return compose(a, std::array<T, 6>{t, d, -t * d, d * (T(3) * t2 - T(1)) / T(3), t * d * (T(2) - T(3) * t2) / T(3),
                                     d * (T(2) + T(15) * (t2 * t2 - t2)) / T(15)});
}

namespace internal {

/// Taylor coefficients 1 to 5 of asin at u; coefficient 0 is zero.
template <class T>
std::array<T, 6> asin_derivatives(const T& u) {
  using std::sqrt;
  const T g2 = T(1) / ((T(1) - u) * (T(1) + u)), g = sqrt(g2), g3 = g * g2, g7 = g2 * g2 * g3, u2 = u * u;
  return {T(0),
          g,
          u * g3 / T(2),
          g2 * g3 * (T(1) + T(2) * u2) / T(6),
          g7 * u * (T(3) + T(2) * u2) / T(8),
          g2 * g7 * (T(3) + u2 * (T(24) + T(8) * u2)) / T(40)};
}

} // namespace internal

/// @{
/// The expansion of a composed function, given the expansion of its argument.
template <class T, int Order, Monomial_set A>
auto asin(const Jet_3<T, Order, A>& a) {
  using std::asin;
  auto t = internal::asin_derivatives(a.value());
  t[0] = asin(a.value());
  return compose(a, t);
}

template <class T, int Order, Monomial_set A>
auto acos(const Jet_3<T, Order, A>& a) {
  using std::acos;
  auto t = internal::asin_derivatives(a.value());
  for (T& coefficient : t) coefficient = -coefficient;
  t[0] = acos(a.value());
  return compose(a, t);
}

template <class T, int Order, Monomial_set A>
auto atan(const Jet_3<T, Order, A>& a) {
  using std::atan;
  const T u = a.value(), g = T(1) / (T(1) + u * u), h = u * g, g2 = g * g, h2 = h * h;
  return compose(a, std::array<T, 6>{atan(u), g, -g * h, g * (h2 - g2 / T(3)), g * h * (g2 - h2),
                                     g * (h2 * (h2 - T(2) * g2) + g2 * g2 / T(5))});
}
/// @}

/// The angle of (x, y), in (-pi, pi]. Computed as the angle of the direction (x_0, y_0) plus the angle relative to it,
/// which is an arctangent near zero in every quadrant.
template <class T, int Order, Monomial_set A, Monomial_set B>
auto atan2(const Jet_3<T, Order, A>& y, const Jet_3<T, Order, B>& x) {
  using std::abs, std::atan2;
  const T scale = T(1) / (abs(x.value()) + abs(y.value()));
  const auto c = x * scale;
  const auto s = y * scale;
  auto across = c.value() * s - s.value() * c;
  across.template at<0>() = T(0);
  return compose(across / (c.value() * c + s.value() * s),
                 std::array<T, 6>{atan2(y.value(), x.value()), factor_for_jump(y.value(), x.value()), T(0),
                                  T(-1) / T(3), T(0), T(1) / T(5)});
}

namespace internal {

/// The length of a vector of jets, given its value r. Squares neither overflow nor underflow: the sum below has the
/// value 1.
template <class T, class... Jets>
auto length(const T& r, const Jets&... x) {
  const T s = T(1) / r;
  return compose((square(x * s) + ...),
                 std::array<T, 6>{r, r / T(2), -r / T(8), r / T(16), r * T(-5) / T(128), r * T(7) / T(256)});
}

} // namespace internal

/// sqrt(x^2 + y^2). At the origin the value is correct and the derivatives are NaN (for intervals: the whole real
/// line).
template <class T, int Order, Monomial_set A, Monomial_set B>
auto hypot(const Jet_3<T, Order, A>& x, const Jet_3<T, Order, B>& y) {
  using std::hypot;
  return internal::length(T(hypot(x.value(), y.value())), x, y);
}

/// sqrt(x^2 + y^2 + z^2); the same holds at the origin.
template <class T, int Order, Monomial_set A, Monomial_set B, Monomial_set C>
auto hypot(const Jet_3<T, Order, A>& x, const Jet_3<T, Order, B>& y, const Jet_3<T, Order, C>& z) {
  using std::hypot;
  return internal::length(T(hypot(T(hypot(x.value(), y.value())), z.value())), x, y, z);
}

#define EQUIAFFINE_MIXED_JET_FUNCTION(name)                                                                            \
  /** The same function of a jet and a number. */                                                                      \
  template <class T, int Order, Monomial_set A, JetScalar<T> S>                                                        \
  auto name(const Jet_3<T, Order, A>& a, const S& s) {                                                                 \
    return name(a, Jet_3<T, Order, 1>(T(s)));                                                                          \
  }                                                                                                                    \
  /** The same function of a number and a jet. */                                                                      \
  template <class T, int Order, Monomial_set A, JetScalar<T> S>                                                        \
  auto name(const S& s, const Jet_3<T, Order, A>& a) {                                                                 \
    return name(Jet_3<T, Order, 1>(T(s)), a);                                                                          \
  }
EQUIAFFINE_MIXED_JET_FUNCTION(max)
EQUIAFFINE_MIXED_JET_FUNCTION(min)
EQUIAFFINE_MIXED_JET_FUNCTION(hypot)
EQUIAFFINE_MIXED_JET_FUNCTION(atan2)
#undef EQUIAFFINE_MIXED_JET_FUNCTION

// The error function, and the step functions floor, sign and fmod, of numbers, packs and jets. Interval.h has them for
// intervals.

/// The sign of x: 1, -1, or x itself if x is 0 or NaN. In templates write `using equiaffine::sign; sign(x)`, since the
/// standard library has no such function.
template <std::floating_point T>
T sign(const T& x) {
  return x > T(0) ? T(1) : x < T(0) ? T(-1) : x;
}

/// @{
/// Applies the function to each lane.
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

/// A step function, given its value. Its derivatives are 0, or NaN if a is at a step. For intervals that contain a
/// step, derivatives are the whole real line.
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
auto erf(const Jet_3<T, Order, A>& a) requires internal::own_functions::HasErf<T> {
  using std::erf;
  using std::exp;
  const T u = a.value(), u2 = u * u;
  const T g =
      T(exp(T(-u2))) * (T(0x1.20dd750429b6dp+0) + T(0x1.1ae3a914fed80p-56)); // 2 / sqrt(pi), as a sum of two doubles
  const T third = (T(4) * u2 - T(2)) / T(6), fifth = (T(4) * u2 * (T(4) * u2 - T(12)) + T(12)) / T(120);
  return compose(a, std::array<T, 6>{T(erf(u)), g, -u * g, g * third, g * u * (T(3) - T(2) * u2) / T(6), g * fifth});
}

/// The largest integer that does not exceed the value of a jet. Derivatives are 0, or NaN at integers.
template <class T, int Order, Monomial_set A>
auto floor(const Jet_3<T, Order, A>& a) requires internal::own_functions::HasFloor<T> {
  using std::floor;
  const T value = floor(a.value());
  return internal::with_steps(a, value, value);
}

/// The sign of the value of a jet: 1, 0 or -1. Derivatives are 0, or NaN where the value is 0.
template <class T, int Order, Monomial_set A>
auto sign(const Jet_3<T, Order, A>& a) requires requires(const T& x) {
  { sign(x) } -> std::convertible_to<T>;
}
{ return internal::with_steps(a, T(sign(a.value())), T(0)); }

/// The remainder a - n b of a / b for an integer n, with the sign of a. Derivatives are NaN where n jumps.
template <class T, int Order, Monomial_set A, Monomial_set B>
auto fmod(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) requires internal::own_functions::HasFmod<T> {
  using std::fmod;
  const T value = fmod(a.value(), b.value()), n = (a.value() - value) / b.value();
  const T jump = jump_of_remainder(a.value(), b.value(), value);
  auto r = a - b * n;
  r.for_each_monomial([&](auto m) __attribute__((always_inline)) { r.template at<m>() = r.template at<m>() + jump; });
  r.template at<0>() = value;
  return r;
}

/// @{
/// The same if one argument is a number.
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto fmod(const Jet_3<T, Order, A>& a, const S& b) requires internal::own_functions::HasFmod<T> {
  return fmod(a, Jet_3<T, Order, 1>(T(b)));
}
template <class T, int Order, Monomial_set B, JetScalar<T> S>
auto fmod(const S& a, const Jet_3<T, Order, B>& b) requires internal::own_functions::HasFmod<T> {
  return fmod(Jet_3<T, Order, 1>(T(a)), b);
}
/// @}

} // namespace equiaffine

#endif
