// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REFERENCE_ESTIMATORS_H
#define EQUIAFFINE_REFERENCE_ESTIMATORS_H

#include <equiaffine/Local_structure_3.h>
#include <equiaffine/internal/direct_estimate.h>
#include <equiaffine/internal/transformation_estimate.h>
#include <equiaffine/named_parameters.h>

#include <array>
#include <cmath>

namespace equiaffine {

/// Co-normal, normal and curvatures by the given way. Not finite where they do not exist.
template <class FT>
Affine_estimate_3<FT> affine_estimate(const Jet_3<FT>& jet, Estimator estimator) {
  using std::abs;
  switch (estimator) {
  case Estimator::TRANSFORMATION: return transformation_estimate(jet);
  case Estimator::DIRECT: {
    const auto& c = jet.coefficients();
    const FT x = abs(c[1]), y = abs(c[2]), z = abs(c[3]);
    return direct_estimate(jet, x > y && x > z ? 0 : y > z ? 1 : 2);
  }
  case Estimator::DIRECT_Z: return direct_estimate(jet, 2);
  default: {
    const auto s = affine_invariants(Monge_chart_3<FT>(jet));
    return {s.conormal, s.normal, s.gaussian_curvature, s.mean_curvature};
  }
  }
}

/// As local_structure(jet, point, rounding), with co-normal, normal, Gaussian and mean curvature of the affine
/// structure by the given way. Where that way alone fails, which is where f_z vanishes or nearly so for DIRECT_Z, the
/// status is PARABOLIC, too.
template <class FT>
Local_structure_3<FT> local_structure(const Jet_3<FT>& jet, const std::array<FT, 3>& point, const FT& rounding,
                                      Estimator estimator) {
  Local_structure_3<FT> s = local_structure(jet, point, rounding);
  if (s.status != Point_status::REGULAR || estimator == Estimator::COMPACT) return s;
  const Affine_estimate_3<FT> estimate = affine_estimate(jet, estimator);
  s.affine.conormal = estimate.conormal;
  s.affine.normal = estimate.normal;
  s.affine.gaussian_curvature = estimate.gaussian_curvature;
  s.affine.mean_curvature = estimate.mean_curvature;
  if (internal::is_finite(s.affine)) return s;
  s.status = Point_status::PARABOLIC;
  s.affine = internal::no_affine_structure<FT>();
  return s;
}

} // namespace equiaffine

#endif
