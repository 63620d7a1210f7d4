// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of jets: composition with functions of one variable, division, exponentials, logarithms, powers and roots.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_JET_FUNCTIONS_3_H
#define EQUIAFFINE_NUMBER_INTERNAL_JET_FUNCTIONS_3_H

#include <equiaffine/number/internal/elementary_functions.h>
#include <equiaffine/number/internal/jet.h>
#include <equiaffine/number/internal/natural_power.h>
#include <equiaffine/number/select.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

namespace equiaffine {

/// phi(a) for a univariate function phi with Taylor coefficients t[k] = phi^(k)(a_0) / k! at the value a_0 of the jet.
/// With the homogeneous parts n1, n2, n3 of a - a_0 the powers need 111 products for a full jet, fewer than one product
/// of two full jets (210) of order 4: no power is formed beyond the total order.
template <class T, int Order, Monomial_set A>
auto compose(const Jet_3<T, Order, A>& a, const std::array<T, 6>& t) {
  const auto n1 = internal::homogeneous_part<1>(a);
  const auto n2 = internal::homogeneous_part<2>(a);
  const auto n3 = internal::homogeneous_part<3>(a);
  const auto n4 = internal::homogeneous_part<4>(a);
  const auto n11 = square(n1);
  const T t2 = T(2) * t[2], t3 = T(3) * t[3];
  const auto sum = t[1] * (n1 + n2 + n3 + n4) + t[2] * n11 + n1 * (t2 * (n2 + n3) + t[3] * n11) +
                   n2 * (t[2] * n2 + t3 * n11) + t[4] * square(n11);
  using Result = Jet_3<T, Order, internal::closure(A & ~Monomial_set(1), Order)>;
  if constexpr (Order < 5) return Result(Jet_3<T, Order, 1>(t[0]) + sum);
  else
    return Result(Jet_3<T, Order, 1>(t[0]) + sum + t[1] * internal::homogeneous_part<5>(a) +
                  n1 * (t2 * n4 + t3 * square(n2) + n11 * (T(T(4) * t[4]) * n2 + t[5] * n11)) +
                  n3 * (t2 * n2 + t3 * n11));
}

namespace internal {

/// a^p, given its value. Powers and logarithms are composed from a / a_0, which is near 1 at any scale of a: powers of
/// a_0 itself would overflow.
template <class T, int Order, Monomial_set A>
auto real_power(const Jet_3<T, Order, A>& a, const T& value, const T& p) {
  std::array<T, 6> t = {value, T(0), T(0), T(0), T(0), T(0)}; // (p choose k) value
  for (int k = 1; k <= Order; ++k) t[std::size_t(k)] = t[std::size_t(k - 1)] * (p - T(k - 1)) / T(k);
  return compose(a * T(T(1) / a.value()), t);
}

/// Whether a function is zero everywhere, as far as its expansion shows.
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

/// exp(a), given its value.
template <class T, int Order, Monomial_set A>
auto exponential(const Jet_3<T, Order, A>& a, const T& e) {
  return compose(a, std::array<T, 6>{T(1), T(1), T(0.5), fraction<1, 6, T>(), fraction<1, 24, T>(),
                                     fraction<1, 120, T>()}) *
         e;
}

} // namespace internal

/// @{
/// The expansion of the function of this name, where the arguments are functions with the given expansions.
template <class T, int Order, Monomial_set A>
auto reciprocal(const Jet_3<T, Order, A>& a) {
  const T r = T(1) / a.value();
  return compose(a * r, std::array<T, 6>{r, -r, r, -r, r, -r});
}

template <class T, int Order, Monomial_set A, Monomial_set B>
auto operator/(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {
  return a * reciprocal(b);
}

template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto operator/(const S& s, const Jet_3<T, Order, A>& a) {
  return T(s) * reciprocal(a);
}

template <class T, int Order, Monomial_set A>
auto exp(const Jet_3<T, Order, A>& a) {
  return internal::exponential(a, internal::exp_value(a.value()));
}

template <class T, int Order, Monomial_set A>
auto log(const Jet_3<T, Order, A>& a) {
  using std::log;
  const T l = log(a.value());
  const T one = T(1) + T(0) * l; // NaN where l is not finite: there 1 / a_0 alone could be
  return compose(a * T(T(1) / a.value()), std::array<T, 6>{l, one, one * T(-0.5), one * fraction<1, 3, T>(),
                                                           one * T(-0.25), one * fraction<1, 5, T>()});
}

/// The root s from a = s^2, degree by degree: 2 s_0 s_n = a_n - (the products of lower parts).
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

template <class T, int Order, Monomial_set A>
auto cbrt(const Jet_3<T, Order, A>& a) {
  using std::cbrt;
  return internal::real_power(a, T(cbrt(a.value())), T(T(1) / T(3)));
}

/// Integer power; for n >= 0 the value of the jet may be zero.
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

/// Real power; an exponent that is a whole number gives the integer power.
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto pow(const Jet_3<T, Order, A>& a, const S& exponent) requires(!std::is_integral_v<S>) {
  using std::pow;
  if constexpr (std::is_floating_point_v<S>)
    if (std::abs(exponent) <= S(std::numeric_limits<short>::max()) && exponent == std::trunc(exponent))
      return pow(a, int(exponent));
  return internal::real_power(a, T(pow(a.value(), T(exponent))), T(exponent));
}

template <class T, int Order, Monomial_set A, Monomial_set B>
auto pow(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {
  using std::log;
  using std::pow;
  using Exponent = decltype(b * log(a));
  const auto zero = [&] { // NaN where b is not positive: there 0^b ends
    const T logarithm = log(b.value());
    return T(logarithm - logarithm);
  };
  const Exponent exponent = internal::is_zero(a) ? Exponent(b * zero()) : b * log(a);
  return internal::exponential(exponent, T(pow(a.value(), b.value())));
}

template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto pow(const S& base, const Jet_3<T, Order, A>& exponent) {
  using std::log;
  using std::pow;
  return internal::exponential(exponent * T(log(T(base))), T(pow(T(base), exponent.value())));
}
/// @}

} // namespace equiaffine

#endif
