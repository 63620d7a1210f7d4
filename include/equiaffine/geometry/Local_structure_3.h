// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_LOCAL_STRUCTURE_3_H
#define EQUIAFFINE_GEOMETRY_LOCAL_STRUCTURE_3_H

#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/geometry/euclidean_structure.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine {

/// Everything that is known at a point of a level set. A number that does not exist is NaN: all of them when the status
/// is SINGULAR or OUTSIDE, the affine ones when it is PARABOLIC. A point is SINGULAR, too, where a number of order 1 in
/// suitable units is beyond the range of FT in those at hand.
template <class FT>
struct Local_structure_3 {
  Point_status status;
  Euclidean_structure_3<FT> euclidean;
  Affine_structure_3<FT> affine;
};

namespace internal {

template <class FT>
Euclidean_structure_3<FT> no_euclidean_structure() {
  const FT nan = std::numeric_limits<FT>::quiet_NaN();
  return {{nan, nan, nan}, nan, nan, {nan, nan, nan}, {nan, nan, nan}, nan, nan};
}

template <class FT>
Affine_structure_3<FT> no_affine_structure() {
  const FT nan = std::numeric_limits<FT>::quiet_NaN();
  return {{{nan, nan, nan}, {nan, nan, nan}, nan, nan, nan, {nan, nan, nan, nan}, {nan, nan}, {nan, nan, nan, nan}},
          false,
          nan,
          nan,
          {nan, nan, nan, nan, nan, nan},
          nan};
}

/// Every coefficient of the jet, and every power of d, takes part in some of these numbers.
template <class FT>
Mask_of<FT> is_finite(const Affine_invariants_3<FT>& s) {
  FT sum = s.gaussian_curvature + s.mean_curvature + s.pick_invariant;
  for (std::size_t i = 0; i < 3; ++i) sum += s.conormal[i] + s.normal[i];
  return is_finite_number(sum);
}

template <class FT>
Mask_of<FT> is_finite(const Euclidean_structure_3<FT>& s) {
  return is_finite_number(FT(s.k1 + s.gaussian_curvature));
}

/// Everything for one number or for each lane of a pack, with whether it exists. Nothing branches on values.
template <class FT>
struct Local_structure_lanes {
  Local_structure_3<FT> structure;
  Mask_of<FT> has_room; ///< d^2 does not underflow: products of as high a degree would, and unlike infinity not be seen
  Mask_of<FT> is_regular;

  explicit Local_structure_lanes(const Jet_3<FT>& jet, const Monge_chart_3<FT>& chart)
      : structure{Point_status::REGULAR, euclidean_structure(chart), affine_structure(chart)},
        has_room(chart.determinant * chart.determinant >= FT(std::numeric_limits<FT>::min())),
        is_regular(has_room && chart.is_steep && chart.is_curved && is_finite_number(jet.value()) &&
                   is_finite(structure.euclidean) && is_finite(structure.affine)) {}
};

/// A unit of f, which makes the largest |f_i| about 1, and one of length, which makes the largest second derivative so:
/// powers of 2, that of length a multiple of 4, so that changing units changes no bit of a number in range.
template <class FT>
struct Natural_units_3 {
  int of_f = 0, of_length = 0; ///< exponents

  explicit Natural_units_3(const Jet_3<FT>& jet) {
    const int first = exponent(jet, 1, 4), second = exponent(jet, 4, 10);
    if (first == none || second == none) return;
    of_length = (first - second) / 4 * 4;
    of_f = first + of_length;
  }

  Jet_3<FT> apply(Jet_3<FT> jet) const {
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

  /// Back to the old units, by the weights of doc/conventions.md.
  void restore(Local_structure_3<FT>& s) const {
    using std::ldexp;
    const auto restore_all = [&](int quarters, auto&... x) { ((x = ldexp(x, of_length / 4 * quarters)), ...); };
    auto& e = s.euclidean;
    auto& a = s.affine;
    restore_all(-4, e.k1, e.k2, e.mean_curvature);
    restore_all(-8, e.gaussian_curvature, a.apolar_cubic[0], a.apolar_cubic[1], a.apolar_cubic[2], a.apolar_cubic[3]);
    restore_all(-12, a.gaussian_curvature);
    restore_all(-6, a.mean_curvature, a.pick_invariant, a.k1, a.k2);
    for (FT& x : a.shape_operator) restore_all(-6, x);
    for (FT& x : a.conormal) restore_all(2, x);
    for (FT& x : a.normal) restore_all(-2, x);
    for (FT& x : a.metric) restore_all(-2, x);
  }

private:
  static constexpr int none = std::numeric_limits<int>::min();

  /// That of the largest of the coefficients [begin, end).
  static int exponent(const Jet_3<FT>& jet, std::size_t begin, std::size_t end) {
    using std::abs;
    using std::frexp;
    FT largest(0);
    for (std::size_t n = begin; n < end; ++n) largest = std::max(largest, FT(abs(jet.coefficients()[n])));
    int result = none;
    if (largest > FT(0)) frexp(largest, &result);
    return result;
  }
};

/// Numbers and status of a point where they do not all exist, or where intermediate ones leave the range of FT: in
/// natural units d decides what the point is, and no unit does.
template <class FT>
Local_structure_3<FT> irregular_structure(const Jet_3<FT>& jet, const Monge_chart_3<FT>& chart, const FT& rounding) {
  Local_structure_3<FT> s{Point_status::SINGULAR, no_euclidean_structure<FT>(), no_affine_structure<FT>()};
  const auto& c = jet.coefficients();
  if (!is_finite_number(c[0])) s.status = Point_status::OUTSIDE;
  const bool is_smooth = std::all_of(c.begin(), c.end(), [](const FT& x) { return is_finite_number(x); });
  if (!is_smooth || !chart.is_steep) return s;
  const Natural_units_3<FT> units(jet);
  const Jet_3<FT> natural = units.apply(jet);
  Monge_chart_3<FT> natural_chart(natural);
  if (rounding > FT(0)) natural_chart.disregard(natural, units.second_derivative(rounding));
  const Local_structure_lanes<FT> lanes(natural, natural_chart);
  Local_structure_3<FT> t = lanes.structure;
  units.restore(t);
  const bool is_lost = natural_chart.is_curved && !lanes.has_room;
  if (is_lost || !is_finite(t.euclidean) || (lanes.is_regular && !is_finite(t.affine))) return s;
  if (lanes.is_regular) return t;
  t.status = Point_status::PARABOLIC;
  t.affine = s.affine;
  return t;
}

} // namespace internal

/// Local structure, Euclidean and affine, of the level set of f through a point, from the jet of f there. The point
/// need not satisfy f = 0. A gradient that one rounding of the coordinates of `point` could have made counts as zero,
/// and so does K_e where errors of second derivatives of up to `rounding` could have made it. About 500 floating-point
/// operations, three times as many where the point is not regular.
template <class FT>
Local_structure_3<FT> local_structure(const Jet_3<FT>& jet, const std::array<FT, 3>& point = {FT(0), FT(0), FT(0)},
                                      const FT& rounding = FT(0)) {
  Monge_chart_3<FT> chart(jet);
  chart.disregard_rounding_of(point, jet);
  if (rounding > FT(0)) chart.disregard(jet, rounding);
  const internal::Local_structure_lanes<FT> lanes(jet, chart);
  return lanes.is_regular ? lanes.structure : internal::irregular_structure(jet, chart, rounding);
}

} // namespace equiaffine

#endif
