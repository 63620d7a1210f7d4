// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_STRADDLING_TRIANGLES_H
#define EQUIAFFINE_SRC_DELAUNAY_STRADDLING_TRIANGLES_H

#include <equiaffine/delaunay/Delaunay_surface_3.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/geometry/Local_structure_3.h>

#include <algorithm>
#include <vector>

namespace equiaffine::internal {

/// The sign of the Gaussian curvature of the surface at a point. It is 0 where the curvature is negligible beside k1
/// and k2, or beside the curvature 1/radius of a facet's ball.
inline int sign_of_gaussian_curvature(const Any_function_3& function, const Any_function_3::Point_3& p, double radius) {
  constexpr double negligible = 1e-8;
  const auto e = local_structure(function.taylor(p)).euclidean;
  const double least = negligible * (e.k1 * e.k1 + e.k2 * e.k2 + negligible / (radius * radius));
  return (e.gaussian_curvature > least) - (e.gaussian_curvature < -least);
}

/// Adds undecided boxes for triangles with vertices on both sides of a parabolic curve, so that the mesh is not
/// certified.
inline void report_straddling_triangles(const Any_function_3& function, double radius,
                                        Delaunay_surface_3<Any_function_3::Kernel>& mesh) {
  std::vector<int> sign;
  for (const auto& p : mesh.points) sign.push_back(sign_of_gaussian_curvature(function, p, radius));
  for (const auto& [a, b, c] : mesh.triangles) {
    if (std::min({sign[a], sign[b], sign[c]}) >= 0 || std::max({sign[a], sign[b], sign[c]}) <= 0) continue;
    mesh.undecided_boxes.push_back(mesh.points[a].bbox() + mesh.points[b].bbox() + mesh.points[c].bbox());
    mesh.is_certified = false;
  }
}

} // namespace equiaffine::internal

#endif
