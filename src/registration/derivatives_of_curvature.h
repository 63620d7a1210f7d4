// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_DERIVATIVES_OF_CURVATURE_H
#define EQUIAFFINE_SRC_REGISTRATION_DERIVATIVES_OF_CURVATURE_H

#include "registration/Framed_point_3.h"
#include <equiaffine/geometry/Monge_chart_3.h>
#include <equiaffine/geometry/euclidean_structure.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace equiaffine::internal {

/// The principal curvatures of a level set, the greater one first, and how they change along their directions. Not finite
/// where the gradient is zero; arbitrary at umbilics. Units: 1/length and 1/length^2.
struct Derivatives_of_curvature {
  Eigen::Vector2d k;
  Eigen::Matrix2d gradient;               ///< row i is that of k[i]
  Eigen::Matrix<double, 3, 2> directions; ///< unit vectors
  Eigen::Vector3d normal;                 ///< along the gradient of the function
};

/// The derivatives of f are those of the level set as a graph over its tangent plane by the chain rule: with f = g h + A /
/// 2 + h B + T / 6 + ..., of which A, B and T are forms of degree 2, 1 and 3, the height is h = -A / (2 g) - (T - 3 A B /
/// g) / (6 g) + ...
inline Derivatives_of_curvature derivatives_of_curvature(const Jet_3<double>& jet) {
  const Euclidean_structure_3<double> s = euclidean_structure(Monge_chart_3<double>(jet));
  Derivatives_of_curvature result;
  result.k << s.k1, s.k2;
  result.directions << vector_of(s.direction1), vector_of(s.direction2);
  result.normal = vector_of(s.normal);
  const double slope = eigen_gradient(jet).stableNorm();
  const Eigen::Vector2d mixed = result.directions.transpose() * eigen_hessian(jet) * result.normal / slope;
  std::array<Eigen::Matrix2d, 2> third = {Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix2d along =
        result.directions.transpose() * eigen_hessian_along(jet, axis) * result.directions / slope;
    for (int d = 0; d < 2; ++d) third[std::size_t(d)] += result.directions(axis, d) * along;
  }
  for (int i = 0; i < 2; ++i)
    for (int d = 0; d < 2; ++d)
      result.gradient(i, d) = -(third[std::size_t(d)](i, i) + (i == d ? 3 : 1) * result.k[i] * mixed[d]);
  return result;
}

} // namespace equiaffine::internal

#endif
