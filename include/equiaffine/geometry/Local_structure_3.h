// SPDX-License-Identifier: GPL-3.0-or-later
// Local_structure_3, the Euclidean and affine structure at a point with its status, computed from a jet, also for packs
// of points. Irregular points are computed in natural units.
#ifndef EQUIAFFINE_GEOMETRY_LOCAL_STRUCTURE_3_H
#define EQUIAFFINE_GEOMETRY_LOCAL_STRUCTURE_3_H

#include <equiaffine/geometry/Monge_chart_3.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/geometry/euclidean_structure.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/select.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

namespace equiaffine {

/// The Euclidean and affine structure at a point of a level set. Numbers that do not exist are NaN: all of them if the
/// status is SINGULAR or OUTSIDE, the affine ones if it is PARABOLIC. A point is also SINGULAR if a number overflows or
/// underflows FT in the given units, even if it would not in other units.
template <class FT>
struct Local_structure_3 {
  Point_status status;                 ///< which numbers exist
  Euclidean_structure_3<FT> euclidean; ///< the Euclidean structure
  Affine_structure_3<FT> affine;       ///< the affine structure
};

/// The local structure at a regular point, or at the regular points of a pack.
template <class FT>
struct Regular_structure_3 {
  Local_structure_3<FT> structure; ///< meaningless at a point that is not regular
  Mask_of<FT> is_regular;          ///< every number exists
  Mask_of<FT> is_steep;            ///< the gradient is not zero, see Monge_chart_3
  Mask_of<FT> is_out_of_range;     ///< Monge_chart_3::d() is not zero, but its powers underflow
};

/// Estimated differences between affine curvatures computed from samples and those of the sampled surface, in the units
/// of the curvatures.
template <class FT>
struct Affine_curvature_error {
  FT affine_gaussian_curvature, ///< of K
      affine_mean_curvature;    ///< of H
};

/// Error estimates of a local structure, each in the unit of its number; the base has those of K and H. The error of a
/// vector is an angle in degrees that 19 of 20 errors do not exceed. NaN if the number does not exist.
template <class FT>
struct Local_structure_error_3 : Affine_curvature_error<FT> {
  FT pick_invariant;               ///< of J
  FT affine_area_density;          ///< of |K_e|^(1/4)
  FT affine_normal;                ///< an angle
  FT normal;                       ///< an angle, also that of the affine co-normal
  FT euclidean_gaussian_curvature, ///< of K_e
      euclidean_mean_curvature,    ///< of H_e
      k1,                          ///< of the larger principal curvature
      k2;                          ///< of the smaller principal curvature
};

} // namespace equiaffine

namespace equiaffine::internal {

/// A unit of f for which the largest |f_i| is about 1, and a unit of length for which the largest second derivative is
/// about 1. Both are powers of 2, and the exponent of the unit of length is a multiple of 4, so that converting units
/// is exact within the range of FT.
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

  /// Converts numbers of unit length^(`quarters` / 4) back to the original unit.
  template <class... Number>
  void restore_all(int quarters, Number&... x) const {
    using std::ldexp;
    ((x = ldexp(x, of_length / 4 * quarters)), ...);
  }

  /// Converts a structure back to the original units, by the weights of doc/conventions.md.
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

// Structures of NaN, and tests whether all numbers are finite.

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
          nan,
          {nan, nan, nan},
          {nan, nan, nan},
          {nan, nan, nan},
          {nan, nan, nan, nan}};
}

/// Whether all numbers are finite. Only some are tested, but every coefficient of the jet and every power of d enters
/// one of them.
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

/// Returns the chart in which the gradient and d count as zero if rounding could account for them.
template <class FT>
Monge_chart_3<FT> chart_within_rounding(const Jet_3<FT>& jet, const std::array<FT, 3>& point,
                                        const std::optional<FT>& rounding) {
  Monge_chart_3<FT> chart(jet);
  chart.ignore_gradient_within_rounding(point, jet);
  if (rounding) chart.ignore_d_within_error(jet, *rounding);
  return chart;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Computes the local structure of the level set of f through a point, or through the points of a pack, from the jet of
/// f. The gradient counts as zero if rounding the coordinates of `point` could account for it. K_e counts as zero if
/// errors of up to `rounding` in second derivatives could account for it; without `rounding` this is not tested. Takes
/// about 500 floating-point operations per number or pack.
template <class FT>
Regular_structure_3<FT> regular_structure(const Jet_3<FT>& jet, const std::array<FT, 3>& point,
                                          const std::optional<std::type_identity_t<FT>>& rounding = {}) {
  const Monge_chart_3<FT> chart = internal::chart_within_rounding(jet, point, rounding);
  Regular_structure_3<FT> s{{Point_status::REGULAR, euclidean_structure(chart), affine_structure(chart)}, {}, {}, {}};
  // If d^2 underflows, so do other products of that degree. Unlike overflow, this is not visible in the result.
  const Mask_of<FT> is_in_range = chart.determinant * chart.determinant >= FT(std::numeric_limits<FT>::min());
  s.is_steep = chart.is_steep;
  s.is_out_of_range = chart.is_curved && !is_in_range;
  s.is_regular = is_in_range && chart.is_steep && chart.is_curved && is_finite_number(jet.value()) &&
                 internal::is_finite(s.structure.euclidean) && internal::is_finite(s.structure.affine);
  return s;
}

/// Computes the status of a point that is not regular according to regular_structure(), and the numbers that exist
/// there. `is_steep` is the one that regular_structure() returned. Takes about 1000 floating-point operations. Uses
/// natural units: the status does not depend on the units of the function and of space, and intermediate results stay
/// within the range of FT.
template <class FT>
Local_structure_3<FT> irregular_structure(const Jet_3<FT>& jet, bool is_steep, const FT& rounding = FT(0)) {
  Local_structure_3<FT> nothing{Point_status::SINGULAR, internal::no_euclidean_structure<FT>(),
                                internal::no_affine_structure<FT>()};
  const auto& c = jet.coefficients();
  if (!is_finite_number(c[0])) nothing.status = Point_status::OUTSIDE;
  const bool is_smooth = std::all_of(c.begin(), c.end(), [](const FT& x) { return is_finite_number(x); });
  if (!is_smooth || !is_steep) return nothing;

  const internal::Natural_units_3<FT> units(jet);
  const std::optional<FT> natural_rounding =
      rounding > FT(0) ? std::optional<FT>(units.second_derivative(rounding)) : std::nullopt;
  const auto natural = regular_structure<FT>(units.apply(jet), {FT(0), FT(0), FT(0)}, natural_rounding);
  Local_structure_3<FT> s = natural.structure;
  units.restore(s.euclidean, s.affine);
  const bool is_too_large = !internal::is_finite(s.euclidean) || (natural.is_regular && !internal::is_finite(s.affine));
  if (natural.is_out_of_range || is_too_large) return nothing;
  if (natural.is_regular) return s;
  s.status = Point_status::PARABOLIC;
  s.affine = nothing.affine;
  return s;
}

/// Computes the local structure of the level set of f through a point from the jet of f. The point need not satisfy f =
/// 0. The gradient counts as zero if rounding the coordinates of `point` could account for it. K_e counts as zero if
/// errors of up to `rounding` in second derivatives could account for it; for 0 this is not tested. Takes about 500
/// floating-point operations, three times as many if the point is not regular.
template <class FT>
Local_structure_3<FT> local_structure(const Jet_3<FT>& jet, const std::array<FT, 3>& point = {FT(0), FT(0), FT(0)},
                                      const FT& rounding = FT(0)) {
  const auto limit = rounding > FT(0) ? std::optional<FT>(rounding) : std::nullopt;
  const Regular_structure_3<FT> regular = regular_structure(jet, point, limit);
  return regular.is_regular ? regular.structure : irregular_structure(jet, regular.is_steep, rounding);
}

} // namespace equiaffine

#endif
