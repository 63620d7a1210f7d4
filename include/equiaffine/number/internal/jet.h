// SPDX-License-Identifier: GPL-3.0-or-later
// Jet_3 with its arithmetic.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_JET_H
#define EQUIAFFINE_NUMBER_INTERNAL_JET_H

#include <equiaffine/number/internal/monomials_3.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace equiaffine {

using internal::Monomial_set;

/// A trivariate Taylor polynomial, truncated at total order `Order` <= 5. It is the expansion of a function of (x, y,
/// z) at a point: the sum of c_ijk dx^i dy^j dz^k with c_ijk = (d^(i+j+k) f / dx^i dy^j dz^k) / (i! j! k!). Order 4 has
/// 35 coefficients, stored in graded lexicographic order (1; x y z; xx xy xz yy yz zz; ...).
///
/// Evaluating a function on the jets of the three coordinates yields its expansion: forward automatic differentiation
/// (Griewank, Walther: Evaluating Derivatives, 2008, chapter 13). Functions of jets are in Jet_3.h.
///
/// `Support` is the set of monomials whose coefficients can be nonzero, known at compile time. A function that uses
/// `auto` for intermediate results computes no coefficient that is zero by its structure. A function with one fixed
/// type works on full jets; it can then accumulate sums in a loop, where the type cannot grow.
///
/// `T` may be any number type with ring operations: float, double, multiprecision, Interval, a SIMD pack. The default
/// constructor leaves the coefficients uninitialized if that of T does.
template <class T, int Order = internal::default_order, Monomial_set Support = internal::all_monomials(Order)>
class Jet_3 {
  static_assert(0 <= Order && Order <= internal::maximal_order);
  static_assert((Support & ~internal::all_monomials(Order)) == 0);

public:
  /// The type of the coefficients.
  using Number_type = T;
  static constexpr int order = Order;                                      ///< the total order of the truncation
  static constexpr Monomial_set support = Support;                         ///< one bit per monomial
  static constexpr std::size_t size = std::size_t(std::popcount(Support)); ///< the number of coefficients

  Jet_3() = default; ///< leaves coefficients of built-in types uninitialized

  /// The constant function.
  Jet_3(const T& value) requires(internal::contains(Support, 0)) {
    c_.fill(T(0));
    c_[0] = value;
  }

  /// The constant function, from another built-in type.
  template <class Number>
  Jet_3(const Number& value) requires(internal::contains(Support, 0) && std::is_arithmetic_v<Number> &&
                                      !std::same_as<Number, T>)
      : Jet_3(T(value)) {}

  /// The same polynomial, with a larger support.
  template <Monomial_set Other>
  Jet_3(const Jet_3<T, Order, Other>& other) requires((Other & ~Support) == 0 && Other != Support) {
    for_each_monomial([&](auto n) __attribute__((always_inline)) {
      this->template at<n>() = other.template coefficient_or_zero<n>();
    });
  }

  /// The jet of coordinate `axis` (0, 1, 2 for x, y, z) at a point where that coordinate is `value`.
  static Jet_3 variable(int axis, const T& value) requires(Support == internal::all_monomials(Order) && Order > 0) {
    Jet_3 jet(value);
    jet.c_[std::size_t(1 + axis)] = T(1);
    return jet;
  }

  /// Position of x^i y^j z^k in the order of the coefficients of a full jet.
  static constexpr int index(int i, int j, int k) { return internal::monomial_index(i, j, k); }

  const T& value() const requires(internal::contains(Support, 0)) { return c_[0]; } ///< the constant coefficient

  /// Coefficient of dx^i dy^j dz^k, i + j + k <= Order: the derivative divided by i! j! k!.
  T coefficient(int i, int j, int k) const {
    const int n = index(i, j, k);
    return internal::contains(Support, n) ? c_[std::size_t(internal::rank(Support, n))] : T(0);
  }

  /// The partial derivative d^(i+j+k) f / dx^i dy^j dz^k.
  T derivative(int i, int j, int k) const {
    constexpr std::array<int, 6> factorial = {1, 1, 2, 6, 24, 120};
    return coefficient(i, j, k) * T(factorial[std::size_t(i)] * factorial[std::size_t(j)] * factorial[std::size_t(k)]);
  }

  /// The coefficients of the monomials in the support, in their order.
  const std::array<T, size>& coefficients() const { return c_; }
  std::array<T, size>& coefficients() { return c_; } ///< writable

  /// Coefficient of monomial number N. Precondition: N is in the support.
  template <int N>
  const T& at() const {
    return c_[std::size_t(internal::rank(Support, N))];
  }
  /// The same, writable.
  template <int N>
  T& at() {
    return c_[std::size_t(internal::rank(Support, N))];
  }

  /// Coefficient of monomial number N; zero if N is not in the support.
  template <int N>
  T coefficient_or_zero() const {
    if constexpr (internal::contains(Support, N)) return at<N>();
    else return T(0);
  }

  /// Calls `f(std::integral_constant<int, n>)` for every monomial n of the support, unrolled. The lambdas in this file
  /// are forced inline because a call costs more than their computation.
  template <class F>
  [[gnu::always_inline]] static constexpr void for_each_monomial(F f) {
    [&]<std::size_t... Rank>(std::index_sequence<Rank...>) __attribute__((always_inline)) {
      (f(std::integral_constant<int, internal::member(Support, Rank)>()), ...);
    }
    (std::make_index_sequence<size>());
  }

  /// The negated polynomial.
  Jet_3 operator-() const {
    Jet_3 r;
    for_each_monomial([&](auto n) __attribute__((always_inline)) { r.template at<n>() = -this->template at<n>(); });
    return r;
  }
  Jet_3 operator+() const { return *this; } ///< the same polynomial

  /// @{
  /// Arithmetic with a number, or with a jet whose result fits the support.
  template <class Other>
  Jet_3& operator+=(const Other& other) {
    return assign(*this + other);
  }
  template <class Other>
  Jet_3& operator-=(const Other& other) {
    return assign(*this - other);
  }
  template <class Other>
  Jet_3& operator*=(const Other& other) {
    return assign(*this * other);
  }
  template <class Other>
  Jet_3& operator/=(const Other& other) {
    return assign(*this / other);
  }
  /// @}

private:
  template <class Result>
  Jet_3& assign(const Result& result) {
    static_assert(std::is_convertible_v<Result, Jet_3>,
                  "the result has monomials that the left side lacks: use a new variable, `auto t = s + y * y`, or "
                  "give the function one type for all its arguments");
    return *this = result;
  }

  std::array<T, size> c_;
};

/// Number types that can be combined with a jet over T.
template <class S, class T>
concept JetScalar = std::same_as<S, T> || std::is_arithmetic_v<S>;

namespace internal {

/// The homogeneous part of degree `Degree` of a jet.
template <int Degree, class T, int Order, Monomial_set A>
auto homogeneous_part(const Jet_3<T, Order, A>& a) {
  Jet_3<T, Order, members_of_degree(A, Degree, Order)> r;
  r.for_each_monomial([&](auto n) __attribute__((always_inline)) { r.template at<n>() = a.template at<n>(); });
  return r;
}

template <int Target, class T, int Order, Monomial_set A, Monomial_set B>
T product_coefficient(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {
  using Pairs = Factor_pairs<A, B, Target>;
  return [&]<std::size_t... P>(std::index_sequence<P...>) __attribute__((always_inline)) {
    return ((a.coefficients()[Pairs::pairs[P].first] * b.coefficients()[Pairs::pairs[P].second]) + ...);
  }
  (std::make_index_sequence<Pairs::size>());
}

template <int Target, class T, int Order, Monomial_set A>
T square_coefficient(const Jet_3<T, Order, A>& a) {
  using Pairs = Factor_pairs<A, A, Target>; // contains (q, p) for every (p, q)
  T mixed = T(0), pure = T(0);
  bool has_mixed = false;
  [&]<std::size_t... P>(std::index_sequence<P...>) __attribute__((always_inline)) {
    (
        [&]() __attribute__((always_inline)) {
          constexpr auto pair = Pairs::pairs[P];
          if constexpr (pair.first < pair.second) {
            const T product = a.coefficients()[pair.first] * a.coefficients()[pair.second];
            mixed = has_mixed ? mixed + product : product;
            has_mixed = true;
          } else if constexpr (pair.first == pair.second) {
            pure = a.coefficients()[pair.first] * a.coefficients()[pair.first];
          }
        }(),
        ...);
  }
  (std::make_index_sequence<Pairs::size>());
  if constexpr (Pairs::size == 1) return pure;
  else if constexpr (Pairs::size % 2 == 0) return mixed + mixed;
  else return mixed + mixed + pure;
}

} // namespace internal

/// @{
/// Arithmetic of truncated polynomials and numbers.
template <class T, int Order, Monomial_set A>
auto square(const Jet_3<T, Order, A>& a) {
  Jet_3<T, Order, internal::product_of_sets(A, A, Order)> r;
  r.for_each_monomial([&](auto n)
                          __attribute__((always_inline)) { r.template at<n>() = internal::square_coefficient<n>(a); });
  return r;
}

template <class T, int Order, Monomial_set A, Monomial_set B>
auto operator+(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {
  Jet_3<T, Order, (A | B)> r;
  r.for_each_monomial([&](auto n) __attribute__((always_inline)) {
    if constexpr (!internal::contains(B, n)) r.template at<n>() = a.template at<n>();
    else if constexpr (!internal::contains(A, n)) r.template at<n>() = b.template at<n>();
    else r.template at<n>() = a.template at<n>() + b.template at<n>();
  });
  return r;
}

template <class T, int Order, Monomial_set A, Monomial_set B>
auto operator-(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {
  Jet_3<T, Order, (A | B)> r;
  r.for_each_monomial([&](auto n) __attribute__((always_inline)) {
    if constexpr (!internal::contains(B, n)) r.template at<n>() = a.template at<n>();
    else if constexpr (!internal::contains(A, n)) r.template at<n>() = -b.template at<n>();
    else r.template at<n>() = a.template at<n>() - b.template at<n>();
  });
  return r;
}

/// The truncated product. A jet times itself is computed as a square, with half the multiplications.
template <class T, int Order, Monomial_set A, Monomial_set B>
auto operator*(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {
  if constexpr (A == B)
    if (&a == &b) return square(a);
  Jet_3<T, Order, internal::product_of_sets(A, B, Order)> r;
  r.for_each_monomial([&](auto n) __attribute__((always_inline)) {
    r.template at<n>() = internal::product_coefficient<n>(a, b);
  });
  return r;
}

template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto operator+(const Jet_3<T, Order, A>& a, const S& s) {
  return a + Jet_3<T, Order, 1>(T(s));
}
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto operator+(const S& s, const Jet_3<T, Order, A>& a) {
  return Jet_3<T, Order, 1>(T(s)) + a;
}
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto operator-(const Jet_3<T, Order, A>& a, const S& s) {
  return a - Jet_3<T, Order, 1>(T(s));
}
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto operator-(const S& s, const Jet_3<T, Order, A>& a) {
  return Jet_3<T, Order, 1>(T(s)) - a;
}
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto operator*(const Jet_3<T, Order, A>& a, const S& s) {
  Jet_3<T, Order, A> r;
  const T factor = T(s);
  r.for_each_monomial([&](auto n) __attribute__((always_inline)) { r.template at<n>() = a.template at<n>() * factor; });
  return r;
}
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto operator*(const S& s, const Jet_3<T, Order, A>& a) {
  return a * s;
}
template <class T, int Order, Monomial_set A, JetScalar<T> S>
auto operator/(const Jet_3<T, Order, A>& a, const S& s) {
  Jet_3<T, Order, A> r;
  const T divisor = T(s);
  r.for_each_monomial([&](auto n)
                          __attribute__((always_inline)) { r.template at<n>() = a.template at<n>() / divisor; });
  return r;
}
/// @}

/// phi(a) for a univariate function phi with Taylor coefficients t[k] = phi^(k)(a_0) / k! at the value a_0 of the jet.
/// Using the homogeneous parts n1, n2, n3 of a - a_0, a full jet of order 4 needs 111 products, fewer than one product
/// of two full jets (210): no power is formed beyond the total order.
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

/// @{
/// Division, using the power series of 1 / b.
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
/// @}

} // namespace equiaffine

#endif
