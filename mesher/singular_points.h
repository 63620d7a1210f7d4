// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESHER_SINGULAR_POINTS_H
#define EQUIAFFINE_MESHER_SINGULAR_POINTS_H

#include <equiaffine/function/concepts.h>
#include <equiaffine/surface/eigen_derivatives.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// The node of a surface near p, where f and its gradient vanish and its Hessian is regular: by Newton's method for the
/// critical point, not further away than `reach`.
template <ImplicitFunctionTraits_3 Traits>
std::optional<typename Traits::Point_3> node_near(const Traits& traits, const typename Traits::Point_3& start,
                                                  double reach) {
  using Vector_3 = typename Traits::Vector_3;
  constexpr int maximal_iterations = 30;
  auto p = start;
  for (int n = 0; n < maximal_iterations; ++n) {
    const auto jet = traits.taylor(p);
    const Eigen::Matrix3d hessian = eigen_hessian(jet);
    const double scale = hessian.norm();
    constexpr double least_determinant = 1e-6; // on a singular curve it is 0
    if (!(std::abs(hessian.determinant()) > least_determinant * scale * scale * scale)) return std::nullopt;
    const Eigen::Vector3d step = -(hessian.inverse() * eigen_gradient(jet));
    p = p + Vector_3(step[0], step[1], step[2]);
    if (!(CGAL::squared_distance(p, start) <= reach * reach)) return std::nullopt;
    const double rounding = 1e-12 * reach;
    if (step.norm() > rounding) continue;
    constexpr double negligible = 1e-10; // f / (|H| reach^2)
    if (std::abs(traits.value(p)) > negligible * scale * reach * reach) return std::nullopt;
    return p;
  }
  return std::nullopt;
}

/// The nodes of a surface in or near some boxes, each once.
template <ImplicitFunctionTraits_3 Traits>
std::vector<typename Traits::Point_3> nodes_in(const Traits& traits, const std::vector<CGAL::Bbox_3>& boxes) {
  using Point_3 = typename Traits::Point_3;
  std::vector<Point_3> nodes;
  for (const CGAL::Bbox_3& box : boxes) {
    const Point_3 center((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2);
    const double reach = 2 * std::max({box.x_span(), box.y_span(), box.z_span()});
    const auto is_near = [&](const Point_3& p, const Point_3& q) {
      return CGAL::squared_distance(p, q) <= 4 * reach * reach;
    };
    if (std::any_of(nodes.begin(), nodes.end(), [&](const Point_3& p) { return is_near(p, center); })) continue;
    if (const auto node = node_near(traits, center, reach)) nodes.push_back(*node);
  }
  return nodes;
}

} // namespace equiaffine::internal

#endif
