// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the structure at a point from the jet there: directly if the point is regular, else in natural units.
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_STRUCTURE_OF_JET_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_STRUCTURE_OF_JET_H

#include <equiaffine/geometry/Affine_structure_3.h>
#include <equiaffine/geometry/Euclidean_structure_3.h>
#include <equiaffine/geometry/Monge_chart_3.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/geometry/Regular_structure_3.h>
#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/geometry/euclidean_structure.h>
#include <equiaffine/geometry/internal/Natural_units_3.h>
#include <equiaffine/number/select.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace equiaffine::internal {

// Structures of NaN for numbers that do not exist, and the test whether all numbers are finite.

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

/// Whether all numbers are finite. Only some are tested, but every coefficient of the jet, and every power of d, takes
/// part in one of these.
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

/// Returns the rounding if it is positive, else nothing.
template <class FT>
std::optional<FT> positive(const FT& rounding) {
  if (rounding > FT(0)) return rounding;
  return std::nullopt;
}

/// Returns the chart in which the gradient, and d, count as zero if rounding could have made them.
template <class FT>
Monge_chart_3<FT> chart_within_rounding(const Jet_3<FT>& jet, const std::array<FT, 3>& point,
                                        const std::optional<FT>& rounding) {
  Monge_chart_3<FT> chart(jet);
  chart.take_gradient_within_rounding_for_zero(point, jet);
  if (rounding) chart.take_d_within_error_for_zero(jet, *rounding);
  return chart;
}

/// The work of regular_structure(). Nothing here branches on values of FT, so that it works for packs.
template <class FT>
Regular_structure_3<FT> regular_structure_of(const Jet_3<FT>& jet, const std::array<FT, 3>& point,
                                             const std::optional<FT>& rounding) {
  const Monge_chart_3<FT> chart = chart_within_rounding(jet, point, rounding);
  Regular_structure_3<FT> s{{Point_status::REGULAR, euclidean_structure(chart), affine_structure(chart)}, {}, {}, {}};
  // If d^2 underflows, so do other products of that degree, and unlike overflow this leaves no trace in the result.
  const Mask_of<FT> has_room = chart.determinant * chart.determinant >= FT(std::numeric_limits<FT>::min());
  s.is_steep = chart.is_steep;
  s.is_out_of_range = chart.is_curved && !has_room;
  s.is_regular = has_room && chart.is_steep && chart.is_curved && is_finite_number(jet.value()) &&
                 is_finite(s.structure.euclidean) && is_finite(s.structure.affine);
  return s;
}

/// The work of irregular_structure(). It computes in natural units, so that the status does not depend on the units of
/// the function and of space, and intermediate numbers stay in the range of FT.
template <class FT>
Local_structure_3<FT> irregular_structure_of(const Jet_3<FT>& jet, bool is_steep, const std::optional<FT>& rounding) {
  Local_structure_3<FT> nothing{Point_status::SINGULAR, no_euclidean_structure<FT>(), no_affine_structure<FT>()};
  const auto& c = jet.coefficients();
  if (!is_finite_number(c[0])) nothing.status = Point_status::OUTSIDE;
  const bool is_smooth = std::all_of(c.begin(), c.end(), [](const FT& x) { return is_finite_number(x); });
  if (!is_smooth || !is_steep) return nothing;

  const Natural_units_3<FT> units(jet);
  const std::optional<FT> natural_rounding =
      rounding ? std::optional<FT>(units.second_derivative(*rounding)) : std::nullopt;
  const auto natural = regular_structure_of<FT>(units.apply(jet), {FT(0), FT(0), FT(0)}, natural_rounding);
  Local_structure_3<FT> s = natural.structure;
  units.restore(s.euclidean, s.affine);
  const bool is_too_large = !is_finite(s.euclidean) || (natural.is_regular && !is_finite(s.affine));
  if (natural.is_out_of_range || is_too_large) return nothing;
  if (natural.is_regular) return s;
  s.status = Point_status::PARABOLIC;
  s.affine = nothing.affine;
  return s;
}

} // namespace equiaffine::internal

#endif
