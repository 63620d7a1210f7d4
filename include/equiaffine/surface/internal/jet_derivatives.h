// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of a function as vectors and matrices from its jet, and the Newton step to a curve.
#ifndef EQUIAFFINE_SURFACE_INTERNAL_JET_DERIVATIVES_H
#define EQUIAFFINE_SURFACE_INTERNAL_JET_DERIVATIVES_H

#include <CGAL/number_type_basic.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace equiaffine {

/// The gradient as a vector of any type.
template <class Vector_3, class Jet>
Vector_3 gradient_of(const Jet& jet) {
  return Vector_3(jet.coefficients()[1], jet.coefficients()[2], jet.coefficients()[3]);
}

/// The gradient as a vector of Eigen.
template <class Jet>
Eigen::Vector3d eigen_gradient(const Jet& jet) {
  return {CGAL::to_double(jet.derivative(1, 0, 0)), CGAL::to_double(jet.derivative(0, 1, 0)),
          CGAL::to_double(jet.derivative(0, 0, 1))};
}

/// The matrix of the second derivatives.
template <class Jet>
Eigen::Matrix3d eigen_hessian(const Jet& jet) {
  Eigen::Matrix3d hessian;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      hessian(row, column) = CGAL::to_double(
          jet.derivative((row == 0) + (column == 0), (row == 1) + (column == 1), (row == 2) + (column == 2)));
  return hessian;
}

/// The derivative of the matrix of the second derivatives along an axis.
template <class Jet>
Eigen::Matrix3d eigen_hessian_along(const Jet& jet, int axis) {
  const auto power = [=](int row, int column, int a) { return (row == a) + (column == a) + (axis == a); };
  Eigen::Matrix3d change;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      change(row, column) =
          CGAL::to_double(jet.derivative(power(row, column, 0), power(row, column, 1), power(row, column, 2)));
  return change;
}

/// The minimum-norm step of Newton's method to the curve f = g = 0 from the jets of f and g at a point; not finite if
/// the gradients are parallel.
template <class Vector_3, class Jet_f, class Jet_g>
Vector_3 step_to_curve(const Jet_f& f, const Jet_g& g) {
  // Gradients are scaled so that no product of four of them overflows or underflows.
  const auto scale_of = [](const auto& jet) {
    const auto& c = jet.coefficients();
    using std::abs;
    return std::max({abs(c[1]), abs(c[2]), abs(c[3])});
  };
  const auto s = scale_of(f), t = scale_of(g);
  const Vector_3 u = gradient_of<Vector_3>(f) / s, v = gradient_of<Vector_3>(g) / t;
  const auto a = f.value() / s, b = g.value() / t;
  const auto uu = u * u, uv = u * v, vv = v * v, determinant = uu * vv - uv * uv;
  return (uv * b - vv * a) / determinant * u + (uv * a - uu * b) / determinant * v;
}

} // namespace equiaffine

#endif
