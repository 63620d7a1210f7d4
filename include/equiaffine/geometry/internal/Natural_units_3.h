// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_NATURAL_UNITS_3_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_NATURAL_UNITS_3_H

#include <equiaffine/geometry/Affine_structure_3.h>
#include <equiaffine/geometry/Euclidean_structure_3.h>
#include <equiaffine/number/Jet_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine::internal {

/// A unit of f that makes the largest |f_i| about 1, and a unit of length that makes the largest second derivative
/// about 1. Both are powers of 2, and the exponent of the unit of length is a multiple of 4, so that changing units is
/// exact for numbers in the range of FT.
template <class FT>
struct Natural_units_3 {
  int of_f = 0, of_length = 0; ///< binary exponents of the units

  template <int Order>
  explicit Natural_units_3(const Jet_3<FT, Order>& jet) {
    const int first = exponent(jet, 1, 4), second = exponent(jet, 4, 10);
    if (first == none || second == none) return;
    of_length = (first - second) / 4 * 4;
    of_f = first + of_length;
  }

  template <int Order>
  Jet_3<FT, Order> apply(Jet_3<FT, Order> jet) const {
    using std::ldexp;
    for (std::size_t n = 0; n < jet.size; ++n) {
      FT& x = jet.coefficients()[n];
      x = ldexp(x, monomials[n].degree() * of_length - of_f);
    }
    return jet;
  }

  FT second_derivative(const FT& x) const {
    using std::ldexp;
    return ldexp(x, 2 * of_length - of_f);
  }

  /// Returns numbers of unit length^(`quarters` / 4) to the old unit.
  template <class... Number>
  void restore_all(int quarters, Number&... x) const {
    using std::ldexp;
    ((x = ldexp(x, of_length / 4 * quarters)), ...);
  }

  /// Returns a structure to the old units, by the weights of doc/conventions.md.
  void restore(Euclidean_structure_3<FT>& e, Affine_structure_3<FT>& a) const {
    restore_all(-4, e.k1, e.k2, e.mean_curvature);
    restore_all(-8, e.gaussian_curvature, a.apolar_cubic[0], a.apolar_cubic[1], a.apolar_cubic[2], a.apolar_cubic[3]);
    restore_all(-12, a.gaussian_curvature);
    restore_all(-6, a.mean_curvature, a.pick_invariant, a.k1, a.k2);
    for (FT& x : a.shape_operator) restore_all(-6, x);
    for (FT& x : a.conormal) restore_all(2, x);
    for (FT& x : a.normal) restore_all(-2, x);
    for (FT& x : a.metric) restore_all(-2, x);
    for (FT& x : a.metric_in_chart) restore_all(-2, x);
    for (FT& x : a.cubic_in_chart) restore_all(-6, x);
  }

private:
  static constexpr int none = std::numeric_limits<int>::min();

  /// The binary exponent of the largest of the coefficients [begin, end).
  template <int Order>
  static int exponent(const Jet_3<FT, Order>& jet, std::size_t begin, std::size_t end) {
    using std::abs;
    using std::frexp;
    FT largest(0);
    for (std::size_t n = begin; n < end; ++n) largest = std::max(largest, FT(abs(jet.coefficients()[n])));
    int result = none;
    if (largest > FT(0)) frexp(largest, &result);
    return result;
  }
};

} // namespace equiaffine::internal

#endif
