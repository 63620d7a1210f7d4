// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_FEATURE_CURVE_3_H
#define EQUIAFFINE_SRC_DELAUNAY_FEATURE_CURVE_3_H

#include <equiaffine/delaunay/internal/mesh_surface.h>
#include <equiaffine/mesh/Polyline_3.h>
#include <equiaffine/surface/parabolic_curves.h>
#include <equiaffine/surface/project_to_surface.h>

#include <functional>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// A curve on the surface that becomes a chain of edges of the mesh.
struct Feature_curve_3 {
  using Kernel = Any_function_3::Kernel;
  using Point_3 = Kernel::Point_3;

  Polyline_3<Kernel> polyline;
  std::function<std::optional<Point_3>(const Point_3&)> project; ///< to a point of the curve nearby, if there is one
  bool reaches_border = false; ///< an end near the border of the clip domain is continued to it
};

/// The features that the caller gave as polylines.
inline std::vector<Feature_curve_3> given_features(const Any_function_3& function, const Meshing_request_3& request) {
  const auto project = [function, reach = request.criteria.radius](const Any_function_3::Point_3& p) {
    const auto found = project_to_surface(function, p, reach);
    return found.has_converged ? std::optional(found.point) : std::nullopt;
  };
  std::vector<Feature_curve_3> features;
  for (const auto& curve : request.feature_curves) features.push_back({curve, project, false});
  return features;
}

/// Appends the parabolic curves of the surface to its features.
inline void append_parabolic_features(const Any_function_3& function,
                                      const std::vector<Polyline_3<Any_function_3::Kernel>>& curves, double reach,
                                      std::vector<Feature_curve_3>& features) {
  const auto project = [function, reach](const Any_function_3::Point_3& p) {
    return project_to_parabolic_curve(function, p, reach * reach);
  };
  for (const auto& curve : curves) features.push_back({curve, project, true});
}

} // namespace equiaffine::internal

#endif
