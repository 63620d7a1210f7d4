// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_EIGEN_DERIVATIVES_H
#define EQUIAFFINE_SURFACE_EIGEN_DERIVATIVES_H

#include <CGAL/number_utils.h>
#include <Eigen/Dense>

namespace equiaffine {

/// The gradient of a function as a vector of Eigen, from its jet.
template <class Jet>
Eigen::Vector3d eigen_gradient(const Jet& jet) {
  return {CGAL::to_double(jet.derivative(1, 0, 0)), CGAL::to_double(jet.derivative(0, 1, 0)),
          CGAL::to_double(jet.derivative(0, 0, 1))};
}

/// The matrix of the second derivatives of a function, from its jet.
template <class Jet>
Eigen::Matrix3d eigen_hessian(const Jet& jet) {
  Eigen::Matrix3d hessian;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      hessian(row, column) = CGAL::to_double(
          jet.derivative((row == 0) + (column == 0), (row == 1) + (column == 1), (row == 2) + (column == 2)));
  return hessian;
}

} // namespace equiaffine

#endif
