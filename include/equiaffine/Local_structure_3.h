// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_LOCAL_STRUCTURE_3_H
#define EQUIAFFINE_LOCAL_STRUCTURE_3_H

#include <equiaffine/affine_structure.h>
#include <equiaffine/euclidean_structure.h>

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
  return {{nan, nan, nan},     {nan, nan, nan}, nan, nan, nan, false, nan, nan, {nan, nan, nan, nan, nan, nan},
          {nan, nan, nan, nan}};
}

template <class FT>
bool is_finite(const Affine_structure_3<FT>& s) {
  FT sum = s.gaussian_curvature + s.mean_curvature + s.pick_invariant;
  for (int i = 0; i < 3; ++i) sum += s.conormal[std::size_t(i)] + s.normal[std::size_t(i)];
  return sum - sum == FT(0);
}

} // namespace internal

/// Local structure, Euclidean and affine, of the level set of f through a point, from the jet of f there. The point
/// need not satisfy f = 0. For `point_magnitude` see Monge_chart_3. About 500 floating-point operations.
template <class FT>
Local_structure_3<FT> local_structure(const Jet_3<FT>& jet, const FT& point_magnitude = FT(0)) {
  const Monge_chart_3<FT> chart(jet, point_magnitude);
  Local_structure_3<FT> s = {chart.status, internal::no_euclidean_structure<FT>(), internal::no_affine_structure<FT>()};
  if (s.status == Point_status::REGULAR || s.status == Point_status::PARABOLIC)
    s.euclidean = euclidean_structure(chart);
  if (s.status == Point_status::REGULAR) {
    s.affine = affine_structure(chart);
    if (!internal::is_finite(s.affine)) { // so near d = 0 that the powers of d leave the range of FT
      s.status = Point_status::PARABOLIC;
      s.affine = internal::no_affine_structure<FT>();
    }
  }
  return s;
}

} // namespace equiaffine

#endif
