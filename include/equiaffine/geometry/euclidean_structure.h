// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_EUCLIDEAN_STRUCTURE_H
#define EQUIAFFINE_GEOMETRY_EUCLIDEAN_STRUCTURE_H

#include <equiaffine/geometry/Euclidean_structure_3.h>
#include <equiaffine/geometry/Monge_chart_3.h>
#include <equiaffine/geometry/internal/euclidean_steps.h>

namespace equiaffine {

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
