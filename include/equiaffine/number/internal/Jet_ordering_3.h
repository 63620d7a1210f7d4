// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of jets that choose by value, comparisons, max, min, abs, and their limits.
#ifndef EQUIAFFINE_NUMBER_INTERNAL_JET_ORDERING_3_H
#define EQUIAFFINE_NUMBER_INTERNAL_JET_ORDERING_3_H

#include <equiaffine/number/internal/jet.h>
#include <equiaffine/number/nonsmooth.h>

#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine {

#define EQUIAFFINE_JET_COMPARISON(op)                                                                                  \
  /** Jets compare by their values, so that a function may branch. */                                                  \
  template <class T, int Order, Monomial_set A, Monomial_set B>                                                        \
  auto operator op(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {                                         \
    return a.value() op b.value();                                                                                     \
  }                                                                                                                    \
  /** Jets compare by their values, so that a function may branch. */                                                  \
  template <class T, int Order, Monomial_set A, JetScalar<T> S>                                                        \
  auto operator op(const Jet_3<T, Order, A>& a, const S& s) {                                                          \
    return a.value() op T(s);                                                                                          \
  }                                                                                                                    \
  /** Jets compare by their values, so that a function may branch. */                                                  \
  template <class T, int Order, Monomial_set A, JetScalar<T> S>                                                        \
  auto operator op(const S& s, const Jet_3<T, Order, A>& a) {                                                          \
    return T(s) op a.value();                                                                                          \
  }
EQUIAFFINE_JET_COMPARISON(<)
EQUIAFFINE_JET_COMPARISON(>)
EQUIAFFINE_JET_COMPARISON(<=)
EQUIAFFINE_JET_COMPARISON(>=)
#undef EQUIAFFINE_JET_COMPARISON

/// The larger of two functions. Where they are equal the value is right and the derivatives are NaN (Interval, where
/// the ranges overlap: the whole line for second and higher derivatives, the hull of both for the first).
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

/// The smaller of two functions, with derivatives as for max().
template <class T, int Order, Monomial_set A, Monomial_set B>
auto min(const Jet_3<T, Order, A>& a, const Jet_3<T, Order, B>& b) {
  return -max(-a, -b);
}

/// @{
/// Overloads for equal types, without which std::max and std::min would match as well after `using std::max`.
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

/// \cond doxygen knows no members of std
/// Limits of jets are those of their coefficients.
template <class T, int Order, equiaffine::Monomial_set Support>
class std::numeric_limits<equiaffine::Jet_3<T, Order, Support>> : public std::numeric_limits<T> {
public:
  static constexpr bool is_iec559 = false; ///< a jet is no number of the processor
};
/// \endcond

#endif
