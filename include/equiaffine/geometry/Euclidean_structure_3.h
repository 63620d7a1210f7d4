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
  std::array<FT, 3> normal;
  FT k1, k2;                                ///< principal curvatures, k1 >= k2
  std::array<FT, 3> direction1, direction2; ///< unit principal directions; direction1, direction2, normal right-handed
  FT gaussian_curvature, mean_curvature;    ///< k1 k2, (k1 + k2) / 2
};

} // namespace equiaffine

#endif
