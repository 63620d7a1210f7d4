// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_REFERENCE_ESTIMATORS_H
#define EQUIAFFINE_GEOMETRY_REFERENCE_ESTIMATORS_H

#include <equiaffine/geometry/Estimator.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/internal/affine_estimate.h>
#include <equiaffine/geometry/internal/estimate_by.h>

#include <array>

namespace equiaffine {

/// Co-normal, normal and curvatures by the given estimator. They are not finite where they do not exist.
template <class FT>
Affine_estimate_3<FT> affine_estimate(const Jet_3<FT>& jet, Estimator estimator) {
  return internal::estimate_by(jet, estimator);
}

/// As local_structure(jet, point, rounding), with co-normal, normal, Gaussian and mean curvature of the affine
/// structure by the given estimator. Where the estimator alone fails, which is where f_z vanishes or nearly so for
/// DIRECT_Z, the point is OUTSIDE what the estimator can do, and nothing exists.
template <class FT>
Local_structure_3<FT> local_structure(const Jet_3<FT>& jet, const std::array<FT, 3>& point, const FT& rounding,
                                      Estimator estimator) {
  return internal::with_estimate(local_structure(jet, point, rounding), jet, estimator);
}

} // namespace equiaffine

#endif
