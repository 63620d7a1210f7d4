// SPDX-License-Identifier: GPL-3.0-or-later
// Affine maps and their kinds, and the maps between meshes that a search returns.
#ifndef EQUIAFFINE_SRC_REGISTRATION_AFFINE_MAP_3_H
#define EQUIAFFINE_SRC_REGISTRATION_AFFINE_MAP_3_H

#include <equiaffine/registration/Registration_options.h>
#include <equiaffine/registration/slippage_of_mesh.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace equiaffine::internal {

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

/// The number of parameters of a map of a kind.
inline int degrees_of_freedom(Map_kind kind) {
  switch (kind) {
  case Map_kind::RIGID: return 6;
  case Map_kind::SIMILARITY: return 7;
  case Map_kind::EQUIAFFINE: return 11;
  default: return 12;
  }
}

/// The nearest matrix of a kind, with the same sign of the determinant. Its orthogonal part is that of the singular
/// value decomposition.
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

/// Coordinates in which points have mean 0 and covariance 1. The points determine them up to an orthogonal map.
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

/// A map of one mesh, or a part of it, onto another one, with its evidence.
struct Shape_match {
  Affine_map_3 map;
  double rms; ///< of the distances of points on the other surface, in the unit of the target
  std::array<double, 2> inliers; ///< fractions of the area of the source, and of the target, on the other surface
  double log10_false_alarms;     ///< base 10 logarithm of the expected number of equally good maps by chance
  std::array<double, 2> contradictions; ///< fractions of points off the other surface although that does not end there
};

/// The maps between meshes that a search found.
struct Shape_matches {
  std::vector<Shape_match> maps = {}; ///< best first
  std::size_t hypotheses = 0;         ///< number of maps that were tried
  double size = 0;                    ///< of the target
  Affine_slippage_3 slippage = {};    ///< of the source; if it slides, each map is one of a continuous family
  std::string reason = {};            ///< why all hypotheses were rejected
};

} // namespace equiaffine::internal

#endif
