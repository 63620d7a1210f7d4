// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the affine structure by the methods of Andrade and Lewiner (2012), to compare with the library's own.
#ifndef EQUIAFFINE_GEOMETRY_REFERENCE_ESTIMATORS_H
#define EQUIAFFINE_GEOMETRY_REFERENCE_ESTIMATORS_H

#include <equiaffine/geometry/Estimator.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/internal/affine_estimate.h>
#include <equiaffine/geometry/internal/estimate_by.h>

#include <array>

namespace equiaffine {

/// Computes co-normal, normal and curvatures by the given estimator. They are not finite where they do not exist.
template <class FT>
Affine_estimate_3<FT> affine_estimate(const Jet_3<FT>& jet, Estimator estimator) {
  return internal::estimate_by(jet, estimator);
}

/// Does the same as local_structure(jet, point, rounding), but the co-normal, normal, Gaussian and mean curvature of
/// the affine structure are those of the given estimator. If only the estimator fails, as DIRECT_Z does where f_z is
/// zero or nearly so, the status is OUTSIDE, and all numbers are NaN.
template <class FT>
Local_structure_3<FT> local_structure(const Jet_3<FT>& jet, const std::array<FT, 3>& point, const FT& rounding,
                                      Estimator estimator) {
  return internal::with_estimate(local_structure(jet, point, rounding), jet, estimator);
}

} // namespace equiaffine

#endif
