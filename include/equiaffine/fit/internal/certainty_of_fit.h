// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_CERTAINTY_OF_FIT_H
#define EQUIAFFINE_FIT_INTERNAL_CERTAINTY_OF_FIT_H

#include <equiaffine/fit/Fitted_structure_3.h>

#include <cmath>

namespace equiaffine::internal {

/// How far the affine curvatures of a fit at a point can be trusted, from 0 to 1: 1 / (1 + 10 e) for an estimated error e
/// of the affine Gaussian curvature K as a part of |K| + H^2, which affine maps keep.
template <class FT>
double certainty_of_fit(const Fitted_structure_3<FT>& fit) {
  const auto& affine = fit.structure.affine;
  const FT size = std::abs(affine.gaussian_curvature) + affine.mean_curvature * affine.mean_curvature;
  const FT part = fit.error.affine_gaussian_curvature / size;
  return std::isfinite(part) ? double(1 / (1 + 10 * part)) : 0;
}

} // namespace equiaffine::internal

#endif
