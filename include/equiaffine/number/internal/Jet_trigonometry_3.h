// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of jets: trigonometric and hyperbolic functions, their inverses, angles and lengths of vectors.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_JET_TRIGONOMETRY_3_H
#define EQUIAFFINE_NUMBER_INTERNAL_JET_TRIGONOMETRY_3_H

#include <equiaffine/number/internal/Jet_functions_3.h>
#include <equiaffine/number/internal/Jet_ordering_3.h>
#include <equiaffine/number/internal/elementary_functions.h>
#include <equiaffine/number/internal/jet.h>
#include <equiaffine/number/nonsmooth.h>
#include <equiaffine/number/select.h>

#include <array>
#include <cmath>

namespace equiaffine {

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

/// Taylor coefficients 1 to 5 of asin at u; the value is left at zero.
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
/// The expansion of the function of this name, where the argument is a function with the given expansion.
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

/// The angle of (x, y), in (-pi, pi]: the angle of the direction (x_0, y_0) plus the angle relative to it, which is
/// an arctangent at zero in every quadrant.
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

/// The length of a vector of jets, given its value r. No square overflows or underflows: the sum below is 1 plus a part
/// without a value.
template <class T, class... Jets>
auto length(const T& r, const Jets&... x) {
  const T s = T(1) / r;
  return compose((square(x * s) + ...),
                 std::array<T, 6>{r, r / T(2), -r / T(8), r / T(16), r * T(-5) / T(128), r * T(7) / T(256)});
}

} // namespace internal

/// sqrt(x^2 + y^2). At the origin the value is right and the derivatives are NaN (Interval: the whole line).
template <class T, int Order, Monomial_set A, Monomial_set B>
auto hypot(const Jet_3<T, Order, A>& x, const Jet_3<T, Order, B>& y) {
  using std::hypot;
  return internal::length(T(hypot(x.value(), y.value())), x, y);
}

/// sqrt(x^2 + y^2 + z^2), at the origin as above.
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

} // namespace equiaffine

#endif
