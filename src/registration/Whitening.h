// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_WHITENING_H
#define EQUIAFFINE_SRC_REGISTRATION_WHITENING_H

#include "registration/Affine_map_3.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include <vector>

namespace equiaffine::internal {

/// Coordinates in which points have mean 0 and covariance 1: the choice of points alone fixes them up to an orthogonal
/// map.
struct Whitening {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d matrix, inverse; ///< x -> matrix (x - mean)

  explicit Whitening(const std::vector<Eigen::Vector3d>& points) {
    for (const auto& p : points) mean += p / double(points.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const auto& p : points) covariance += (p - mean) * (p - mean).transpose() / double(points.size());
    inverse = covariance.llt().matrixL();
    matrix = inverse.inverse();
  }

  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return matrix * (p - mean); }

  Affine_map_3 to() const { return {matrix, -(matrix * mean)}; } ///< the map to these coordinates
  Affine_map_3 from() const { return {inverse, mean}; }          ///< the map back
};

} // namespace equiaffine::internal

#endif
