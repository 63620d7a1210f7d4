// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_EUCLIDEAN_STRUCTURE_3_H
#define EQUIAFFINE_GEOMETRY_EUCLIDEAN_STRUCTURE_3_H

#include <array>

namespace equiaffine {

/// The Euclidean structure of an oriented surface at a point. The shape operator is S with dn(X) = -S X for the unit
/// normal n along the gradient: a sphere of radius r with outward gradient has k1 = k2 = -1/r, Gaussian curvature 1/r^2
/// and mean curvature -1/r. Units: curvatures 1/length, Gaussian curvature 1/length^2.
template <class FT>
struct Euclidean_structure_3 {
  std::array<FT, 3> normal;     ///< the unit normal n
  FT k1,                        ///< the greater principal curvature
      k2;                       ///< the other one
  std::array<FT, 3> direction1, ///< unit principal direction of k1
      direction2;               ///< that of k2; direction1, direction2, normal are right-handed
  FT gaussian_curvature,        ///< k1 k2
      mean_curvature;           ///< (k1 + k2) / 2
};

} // namespace equiaffine

#endif
