// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_AFFINE_MAP_3_H
#define EQUIAFFINE_SRC_REGISTRATION_AFFINE_MAP_3_H

#include <equiaffine/registration/Map_kind.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>

namespace equiaffine::internal {

/// The map p -> matrix p + translation.
struct Affine_map_3 {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return matrix * p + translation; }

  friend Affine_map_3 operator*(const Affine_map_3& a, const Affine_map_3& b) {
    return {a.matrix * b.matrix, a(b.translation)};
  }

  Affine_map_3 inverse() const {
    const Eigen::Matrix3d m = matrix.inverse();
    return {m, -(m * translation)};
  }

  template <class Aff_transformation_3>
  Aff_transformation_3 to_CGAL() const {
    const auto& m = matrix;
    const auto& t = translation;
    return {m(0, 0), m(0, 1), m(0, 2), t[0], m(1, 0), m(1, 1), m(1, 2), t[1], m(2, 0), m(2, 1), m(2, 2), t[2]};
  }
};

/// The number of parameters of a map of that kind.
inline int degrees_of_freedom(Map_kind kind) {
  switch (kind) {
  case Map_kind::RIGID: return 6;
  case Map_kind::SIMILARITY: return 7;
  case Map_kind::EQUIAFFINE: return 11;
  default: return 12;
  }
}

/// The matrix of that kind nearest to `matrix`, with the same sign of the determinant: its orthogonal part is that of
/// the singular value decomposition.
inline Eigen::Matrix3d nearest_of_kind(const Eigen::Matrix3d& matrix, Map_kind kind) {
  const double scale = std::cbrt(std::abs(matrix.determinant()));
  if (kind == Map_kind::AFFINE) return matrix;
  if (kind == Map_kind::EQUIAFFINE) return matrix / scale;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d orthogonal = svd.matrixU() * svd.matrixV().transpose();
  return kind == Map_kind::RIGID ? orthogonal : Eigen::Matrix3d(scale * orthogonal);
}

/// The ratio of the largest to the smallest singular value.
inline double condition(const Eigen::Matrix3d& matrix) {
  const Eigen::Vector3d values = matrix.jacobiSvd().singularValues();
  return values[0] / values[2];
}

} // namespace equiaffine::internal

#endif
