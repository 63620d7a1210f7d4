// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_LOCAL_STRUCTURE_3_H
#define EQUIAFFINE_LOCAL_STRUCTURE_3_H

#include <equiaffine/Point_status.h>
#include <equiaffine/affine_structure.h>
#include <equiaffine/euclidean_structure.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace equiaffine {

/// Everything that is known at a point of a level set. A number that does not exist is NaN: all of them when the status
/// is SINGULAR or OUTSIDE, the affine ones when it is PARABOLIC.
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

/// Why a point is not regular: the value is NaN or infinite; another coefficient is, or the gradient vanishes; d does
/// up to rounding; or numbers leave the range of FT, which is as good as parabolic near d = 0, else as good as singular.
template <class FT>
Point_status reason_of_irregularity(const Jet_3<FT>& jet, const Monge_chart_3<FT>& chart,
                                    const Euclidean_structure_3<FT>& euclidean) {
  const auto& c = jet.coefficients();
  if (!is_finite_number(c[0])) return Point_status::OUTSIDE;
  const bool is_smooth = std::all_of(c.begin(), c.end(), [](const FT& x) { return is_finite_number(x); });
  const bool is_flat = !chart.is_curved || chart.d() * chart.d() < FT(1);
  return is_smooth && chart.is_steep && is_flat && is_finite(euclidean) ? Point_status::PARABOLIC
                                                                        : Point_status::SINGULAR;
}

/// Everything for one number or for each lane of a pack, with whether it exists. Nothing branches on values.
template <class FT>
struct Local_structure_lanes {
  Local_structure_3<FT> structure;
  Mask_of<FT> is_regular;

  explicit Local_structure_lanes(const Jet_3<FT>& jet, const Monge_chart_3<FT>& chart)
      : structure{Point_status::REGULAR, euclidean_structure(chart), affine_structure(chart)},
        is_regular(chart.is_steep && chart.is_curved && is_finite_number(jet.value()) &&
                   is_finite(structure.euclidean) && is_finite(structure.affine)) {}
};

} // namespace internal

/// Local structure, Euclidean and affine, of the level set of f through a point, from the jet of f there. The point
/// need not satisfy f = 0. A gradient that one rounding of the coordinates of `point` could have made counts as zero, and
/// so does K_e where errors of second derivatives of up to `rounding` could have made it. About 500 floating-point operations.
template <class FT>
Local_structure_3<FT> local_structure(const Jet_3<FT>& jet, const std::array<FT, 3>& point = {FT(0), FT(0), FT(0)},
                                      const FT& rounding = FT(0)) {
  Monge_chart_3<FT> chart(jet);
  chart.disregard_rounding_of(point, jet);
  if (rounding > FT(0)) chart.disregard(jet, rounding);
  const internal::Local_structure_lanes<FT> lanes(jet, chart);
  Local_structure_3<FT> s = lanes.structure;
  if (lanes.is_regular) return s;
  s.status = internal::reason_of_irregularity(jet, chart, s.euclidean);
  s.affine = internal::no_affine_structure<FT>();
  if (s.status != Point_status::PARABOLIC) s.euclidean = internal::no_euclidean_structure<FT>();
  return s;
}

} // namespace equiaffine

#endif
