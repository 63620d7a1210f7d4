// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_EUCLIDEAN_STRUCTURE_H
#define EQUIAFFINE_GEOMETRY_EUCLIDEAN_STRUCTURE_H

#include <equiaffine/geometry/Monge_chart_3.h>
#include <equiaffine/geometry/internal/euclidean_steps.h>

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

/// Computes the Euclidean structure from the second derivatives of a chart.
template <class FT>
Euclidean_structure_3<FT> euclidean_structure(const Monge_chart_3<FT>& chart) {
  return internal::euclidean_structure_of(chart);
}

/// The shape index of principal curvatures k1 >= k2, (2 / pi) atan2(k1 + k2, k1 - k2), whatever the size of the
/// surface: -1 on a sphere with outward normals, -1/2 on such a cylinder, 0 on a symmetric saddle, 1/2 and 1 on a
/// cylinder and a sphere with inward normals. NaN where both curvatures are zero. See Koenderink, van Doorn: Surface
/// shape and curvature scales, 1992.
template <class FT>
FT shape_index(const FT& k1, const FT& k2) {
  return internal::shape_index_of(k1, k2);
}

/// The curvedness of principal curvatures k1, k2, sqrt((k1^2 + k2^2) / 2): 1 / r on a sphere of radius r, 0 on a plane.
/// Unit: 1/length. Source: as for shape_index().
template <class FT>
FT curvedness(const FT& k1, const FT& k2) {
  return internal::curvedness_of(k1, k2);
}

} // namespace equiaffine

#endif
