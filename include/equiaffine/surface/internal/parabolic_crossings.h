// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_PARABOLIC_CROSSINGS_H
#define EQUIAFFINE_SURFACE_INTERNAL_PARABOLIC_CROSSINGS_H

#include <equiaffine/surface/internal/jet_derivatives.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>
#include <Eigen/Dense>

#include <cmath>
#include <optional>

namespace equiaffine::internal {

/// Finds a point where two branches of the curve f = d = 0 cross, not further than `reach` from `start`. It is a saddle
/// of d on f = 0, found by Newton's method for f = 0, grad d = m grad f. `jets(p)` is the pair of the jets of f and d,
/// of order 2 at least.
template <class Point_3, class Vector_3, class Jets>
std::optional<Point_3> crossing_near(const Point_3& start, double reach, const Jets& jets) {
  constexpr int maximal_iterations = 20;
  Point_3 p = start;
  std::optional<double> multiplier;
  for (int n = 0; n < maximal_iterations; ++n) {
    const auto [f, d] = jets(p);
    const Eigen::Vector3d f1 = eigen_gradient(f), d1 = eigen_gradient(d);
    const double norm = f1.norm();
    if (!multiplier) multiplier = f1.dot(d1) / (norm * norm);
    const Eigen::Matrix3d hessian = eigen_hessian(d) - *multiplier * eigen_hessian(f);
    Eigen::Matrix4d jacobian = Eigen::Matrix4d::Zero();
    jacobian.topLeftCorner<3, 3>() = hessian;
    jacobian.topRightCorner<3, 1>() = -f1;
    jacobian.bottomLeftCorner<1, 3>() = f1.transpose();
    Eigen::Vector4d defect;
    defect << d1 - *multiplier * f1, CGAL::to_double(f.value());
    const Eigen::Vector4d step = -jacobian.fullPivLu().solve(defect);
    p = p + Vector_3(step[0], step[1], step[2]);
    *multiplier += step[3];
    if (!(CGAL::to_double(CGAL::squared_distance(p, start)) <= reach * reach)) return std::nullopt; // also NaN
    const double length = step.head<3>().norm();
    if (length > 1e-9 * reach) continue;
    // If the gradient of f is replaced by the unit normal, minus the determinant is that of the Hessian of d within the
    // tangent plane, which is negative at a saddle.
    jacobian.topRightCorner<3, 1>() = f1 / norm;
    jacobian.bottomLeftCorner<1, 3>() = f1.transpose() / norm;
    const double scale = hessian.norm(), determinant = -jacobian.determinant();
    // Both are relative: to the square of the Hessian, and to what d is at the distance `reach`.
    constexpr double least_determinant = 1e-4, negligible_value = 1e-6;
    if (!(determinant < -least_determinant * scale * scale)) return std::nullopt;
    if (!(std::abs(CGAL::to_double(d.value())) <= negligible_value * scale * reach * reach)) return std::nullopt;
    return p;
  }
  return std::nullopt;
}

} // namespace equiaffine::internal

#endif
