// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_ESTIMATE_BY_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_ESTIMATE_BY_H

#include <equiaffine/geometry/Estimator.h>
#include <equiaffine/geometry/Regular_structure_3.h>
#include <equiaffine/geometry/internal/direct_estimate.h>
#include <equiaffine/geometry/internal/missing_structure.h>
#include <equiaffine/geometry/internal/transformation_estimate.h>

#include <algorithm>
#include <cmath>

namespace equiaffine::internal {

/// Returns the jet of f times a power of 2 that makes the largest |f_i| about 1: the paper's formulas raise derivatives
/// to the power of 7 and more, which soon leaves the range of FT. The surface does not depend on the factor.
template <class FT>
Jet_3<FT> with_gradient_about_one(Jet_3<FT> jet) {
  using std::abs;
  using std::frexp;
  using std::ldexp;
  const auto& c = jet.coefficients();
  const FT size = std::max({FT(abs(c[1])), FT(abs(c[2])), FT(abs(c[3]))});
  if (size > FT(0) && is_finite_number(size)) {
    int exponent;
    frexp(size, &exponent);
    const FT factor = ldexp(FT(1), -std::clamp(exponent, -1000, 1000)); // finite also for subnormal sizes
    for (FT& x : jet.coefficients()) x = x * factor;
  }
  return jet;
}

template <class FT>
Affine_estimate_3<FT> estimate_by(const Jet_3<FT>& jet_of_any_size, Estimator estimator) {
  using std::abs;
  const Jet_3<FT> jet = with_gradient_about_one(jet_of_any_size);
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

/// Returns the structure `s` with the numbers of the estimator in place of its affine ones, or the status OUTSIDE if
/// the estimator fails.
template <class FT>
Local_structure_3<FT> with_estimate(Local_structure_3<FT> s, const Jet_3<FT>& jet, Estimator estimator) {
  if (s.status != Point_status::REGULAR || estimator == Estimator::COMPACT) return s;
  const Affine_estimate_3<FT> estimate = estimate_by(jet, estimator);
  s.affine.conormal = estimate.conormal;
  s.affine.normal = estimate.normal;
  s.affine.gaussian_curvature = estimate.gaussian_curvature;
  s.affine.mean_curvature = estimate.mean_curvature;
  if (is_finite(s.affine)) return s;
  return {Point_status::OUTSIDE, no_euclidean_structure<FT>(), no_affine_structure<FT>()};
}

} // namespace equiaffine::internal

#endif
