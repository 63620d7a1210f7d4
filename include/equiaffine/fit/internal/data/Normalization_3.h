// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_DATA_NORMALIZATION_3_H
#define EQUIAFFINE_FIT_INTERNAL_DATA_NORMALIZATION_3_H

#include <equiaffine/fit/internal/data/Data_points_3.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// The affine map to coordinates in which the edges between neighbors have no preferred direction: the sum of e e^T
/// over all edges e is a multiple of the identity, with edges of length 1 on average. An affine image of the points has
/// the same coordinates but for a rotation.
///
/// Edges and not points, since points that are spread evenly over a surface keep even distances.
struct Normalization_3 {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return matrix * (p - origin); }

  Eigen::Vector3d inverse(const Eigen::Vector3d& p) const { return origin + matrix.inverse() * p; }

  /// The factor of lengths that has the effect on volumes that the map has.
  double scale() const { return std::cbrt(matrix.determinant()); }

  /// The factors of lengths in the directions that are stretched most and least.
  double greatest_stretch() const { return matrix.operatorNorm(); }
  double least_stretch() const { return 1 / matrix.inverse().operatorNorm(); }
};

/// Directions in which the edges are a thousand times as short as in others, as for points in a plane, are stretched no
/// further.
inline Normalization_3 normalization_of(const std::vector<Eigen::Vector3d>& points,
                                        const std::vector<Data_points_3::Edge>& edges) {
  Normalization_3 result;
  if (points.empty()) return result;
  for (const auto& p : points) result.origin += p / double(points.size());
  double longest = 0;
  for (const auto& [i, j] : edges) longest = std::max(longest, (points[i] - points[j]).lpNorm<Eigen::Infinity>());
  if (!(longest > 0)) return result;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const auto& [i, j] : edges) {
    const Eigen::Vector3d edge = (points[i] - points[j]) / longest;
    sum += edge * edge.transpose() / double(edges.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum);
  Eigen::Vector3d lengths = (3 * solver.eigenvalues().cwiseMax(0)).cwiseSqrt();
  lengths = lengths.cwiseMax(1e-3 * lengths.maxCoeff());
  result.matrix =
      solver.eigenvectors() * (lengths * longest).cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
  return result;
}

/// Data points in normal coordinates.
struct Normalized_data {
  Data_points_3 data;
  Normalization_3 normalization;
};

} // namespace equiaffine::internal

#endif
