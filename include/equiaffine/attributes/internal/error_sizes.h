// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of which errors are called parts, see error_table.h.
#ifndef EQUIAFFINE_ATTRIBUTES_INTERNAL_ERROR_SIZES_H
#define EQUIAFFINE_ATTRIBUTES_INTERNAL_ERROR_SIZES_H

#include <equiaffine/geometry/Regular_structure_3.h>
#include <equiaffine/geometry/euclidean_structure.h>

#include <cmath>

namespace equiaffine::internal {

/// An angle is known to 100 % within this many degrees.
inline constexpr double whole_angle = 30;

template <class FT>
FT affine_size(const Local_structure_3<FT>& s) {
  return std::abs(s.affine.gaussian_curvature) + s.affine.mean_curvature * s.affine.mean_curvature;
}

/// An error of an affine curvature that does not matter: 1e-9 of the size that is natural beside K_e, a power of |K_e|.
/// A K that is zero is known to within this, but not to within any part of itself.
template <class FT>
FT negligible_error(const FT& euclidean_gaussian_curvature, const FT& power) {
  return FT(1e-9) * std::pow(std::abs(euclidean_gaussian_curvature), power);
}

template <class FT>
FT curved_size(const Local_structure_3<FT>& s) {
  return curvedness(s.euclidean.k1, s.euclidean.k2);
}

template <class FT>
FT angle_size(const Local_structure_3<FT>&) {
  return whole_angle;
}

} // namespace equiaffine::internal

#endif
