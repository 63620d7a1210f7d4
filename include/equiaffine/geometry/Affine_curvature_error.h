// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_AFFINE_CURVATURE_ERROR_H
#define EQUIAFFINE_GEOMETRY_AFFINE_CURVATURE_ERROR_H

namespace equiaffine {

/// The estimated differences between affine curvatures that were computed from samples and those of the surface that
/// was sampled, in the units of the curvatures.
template <class FT>
struct Affine_curvature_error {
  FT affine_gaussian_curvature, ///< of K
      affine_mean_curvature;    ///< of H
};

} // namespace equiaffine

#endif
