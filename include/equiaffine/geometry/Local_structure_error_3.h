// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_LOCAL_STRUCTURE_ERROR_3_H
#define EQUIAFFINE_GEOMETRY_LOCAL_STRUCTURE_ERROR_3_H

#include <equiaffine/geometry/Affine_curvature_error.h>

namespace equiaffine {

/// Estimates of the errors of a local structure, each in the unit of its number. The base has
/// `affine_gaussian_curvature` and `affine_mean_curvature`. That of a vector is an angle in degrees, which 19 of 20 errors do not exceed. NaN where
/// the number does not exist.
template <class FT>
struct Local_structure_error_3 : Affine_curvature_error<FT> {
  FT pick_invariant;               ///< of J
  FT affine_area_density;          ///< of |K_e|^(1/4)
  FT affine_normal;                ///< an angle
  FT normal;                       ///< an angle, also that of the affine co-normal
  FT euclidean_gaussian_curvature, ///< of K_e
      euclidean_mean_curvature,    ///< of H_e
      k1,                          ///< of the greater principal curvature
      k2;                          ///< of the other one
};

} // namespace equiaffine

#endif
