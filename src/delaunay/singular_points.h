// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_SINGULAR_POINTS_H
#define EQUIAFFINE_SRC_DELAUNAY_SINGULAR_POINTS_H

#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/surface/internal/jet_derivatives.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/squared_distance_3.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// Finds the node of a surface near a point, an isolated singular point such as the apex of a cone: f and its gradient
/// are 0 there, and its Hessian is regular. Newton's method finds it as a critical point of f, not further away than
/// `reach`.
template <ImplicitFunctionTraits_3 Traits>
std::optional<typename Traits::Point_3> node_near(const Traits& traits, const typename Traits::Point_3& start,
                                                  double reach) {
  using Vector_3 = typename Traits::Vector_3;
  constexpr int maximal_iterations = 30;
  constexpr double least_determinant = 1e-6; // relative to |H|^3; on a singular curve the determinant is 0
  constexpr double negligible = 1e-10;       // f, relative to |H| reach^2
  const double rounding = 1e-12 * reach;
  auto p = start;
  for (int n = 0; n < maximal_iterations; ++n) {
    const auto jet = traits.taylor(p);
    const Eigen::Matrix3d hessian = eigen_hessian(jet);
    const double scale = hessian.norm();
    if (!(std::abs(hessian.determinant()) > least_determinant * scale * scale * scale)) return std::nullopt;
    const Eigen::Vector3d step = -(hessian.inverse() * eigen_gradient(jet));
    p = p + Vector_3(step[0], step[1], step[2]);
    if (!(CGAL::squared_distance(p, start) <= reach * reach)) return std::nullopt;
    if (step.norm() > rounding) continue;
    if (std::abs(traits.value(p)) > negligible * scale * reach * reach) return std::nullopt;
    return p;
  }
  return std::nullopt;
}

/// Finds the isolated singular point of a surface near a point where f has no gradient, such as the apex of half a cone
/// or of a pyramid, not much further away than `reach`. The tangent planes around an apex nearly meet in it: their least
/// squares point is computed from gradients at points around, at smaller and smaller distances.
template <ImplicitFunctionTraits_3 Traits>
std::optional<typename Traits::Point_3> apex_near(const Traits& traits, const typename Traits::Point_3& start,
                                                  double reach) {
  using Vector_3 = typename Traits::Vector_3;
  constexpr int directions = 16;
  constexpr double shrinkage = 8, last_distance = 1e-7; // of the points around, relative to the reach
  constexpr double least_eigenvalue = 1e-4;             // relative to the largest one; it tends to 0 except at an apex
  auto p = start;
  for (double distance = reach; distance > last_distance * reach; distance /= shrinkage) {
    Eigen::Matrix3d normals = Eigen::Matrix3d::Zero();
    Eigen::Vector3d offsets = Eigen::Vector3d::Zero();
    for (int n = 0; n < directions; ++n) { // on a spiral from pole to pole
      const double z = 1 - (2 * n + 1.0) / directions, longitude = (n + 0.5) * std::numbers::pi * (3 - std::sqrt(5.0));
      const double r = std::sqrt(1 - z * z);
      const Eigen::Vector3d to_point = distance * Eigen::Vector3d(r * std::cos(longitude), r * std::sin(longitude), z);
      const auto jet = first_order(traits, p + Vector_3(to_point[0], to_point[1], to_point[2]));
      const Eigen::Vector3d gradient = eigen_gradient(jet), normal = gradient.normalized();
      if (!normal.allFinite()) return std::nullopt;
      normals += normal * normal.transpose();
      offsets += normal * (normal.dot(to_point) - jet.value() / gradient.norm());
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normals, Eigen::EigenvaluesOnly);
    if (!(solver.eigenvalues()[0] > least_eigenvalue * solver.eigenvalues()[2])) return std::nullopt;
    const Eigen::Vector3d step = normals.inverse() * offsets;
    if (!(step.norm() <= distance)) return std::nullopt;
    p = p + Vector_3(step[0], step[1], step[2]);
  }
  return p;
}

/// The isolated singular points of a surface in or near some boxes, each once.
template <ImplicitFunctionTraits_3 Traits>
std::vector<typename Traits::Point_3> singular_points_in(const Traits& traits, const std::vector<CGAL::Bbox_3>& boxes) {
  using Point_3 = typename Traits::Point_3;
  std::vector<Point_3> points;
  for (const CGAL::Bbox_3& box : boxes) {
    const Point_3 center((box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2);
    const double reach = 2 * std::max({box.x_span(), box.y_span(), box.z_span()});
    const auto is_near_center = [&](const Point_3& p) {
      return CGAL::squared_distance(p, center) <= 4 * reach * reach;
    };
    if (std::any_of(points.begin(), points.end(), is_near_center)) continue; // it would be found again
    if (const auto point = node_near(traits, center, reach)) points.push_back(*point);
    else if (const auto apex = apex_near(traits, center, reach)) points.push_back(*apex);
  }
  return points;
}

} // namespace equiaffine::internal

#endif
