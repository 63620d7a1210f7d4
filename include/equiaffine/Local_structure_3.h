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
bool is_finite(const FT& x) {
  return x - x == FT(0);
}

template <class FT>
bool is_finite(const Affine_structure_3<FT>& s) {
  FT sum = s.gaussian_curvature + s.mean_curvature + s.pick_invariant;
  for (int i = 0; i < 3; ++i) sum += s.conormal[std::size_t(i)] + s.normal[std::size_t(i)];
  return is_finite(sum);
}

/// Powers of d that leave the range of FT: near d = 0 the point is as good as parabolic, else as good as singular.
template <class FT>
void withdraw_overflow(Local_structure_3<FT>& s, const FT& d) {
  const bool is_nearly_parabolic = is_finite(d) && d * d < FT(1);
  s.status = is_nearly_parabolic ? Point_status::PARABOLIC : Point_status::SINGULAR;
  s.affine = no_affine_structure<FT>();
  if (!is_nearly_parabolic) s.euclidean = no_euclidean_structure<FT>();
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
  if (s.status == Point_status::REGULAR) s.affine = affine_structure(chart);
  const bool is_overflow = !internal::is_finite(s.euclidean.k1 + s.euclidean.gaussian_curvature) ||
                           (s.status == Point_status::REGULAR && !internal::is_finite(s.affine));
  if (is_overflow && (s.status == Point_status::REGULAR || s.status == Point_status::PARABOLIC))
    internal::withdraw_overflow(s, chart.d);
  return s;
}

} // namespace equiaffine

#endif
