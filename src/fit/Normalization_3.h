// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_NORMALIZATION_3_H
#define EQUIAFFINE_SRC_FIT_NORMALIZATION_3_H

#include "fit/Data_points_3.h"
#include <equiaffine/base/internal/random_subset.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// The affine map to coordinates in which the edges e between neighbors have no preferred direction: the sum of
/// e e^T is a multiple of the identity, with edges of length 1 on average. An affine image of the points has the same
/// coordinates but for a rotation.
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

/// The symmetric matrix to coordinates in which the sum of e e^T over all edges e of all stars has no preferred direction
/// and the edges have length 1 on average. Directions in which the edges are a thousand times as short as in others, as
/// for points in a plane, are stretched no further.
///
/// An edge counts as three times as long as the lower quartile of its star at most, so that long triangles, as along a
/// cylinder, do not decide, while sparse parts of the data do.
inline Eigen::Matrix3d whitening_of(const std::vector<std::vector<Eigen::Vector3d>>& stars) {
  constexpr int steps = 20;
  constexpr double most = 3, least_length = 1e-3;
  Eigen::Matrix3d whitening = Eigen::Matrix3d::Zero(); // all lengths are 0 at first, and no edge is too long
  std::vector<double> lengths;
  for (int step = 0; step < steps; ++step) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double count = 0;
    for (const auto& star : stars) {
      lengths.clear();
      for (const auto& edge : star) lengths.push_back((whitening * edge).norm());
      std::vector<double> sorted = lengths;
      const auto quartile = sorted.begin() + std::ptrdiff_t(sorted.size() / 4);
      std::nth_element(sorted.begin(), quartile, sorted.end());
      for (std::size_t k = 0; k < star.size(); ++k) {
        const double part = lengths[k] > most * *quartile ? most * *quartile / lengths[k] : 1;
        sum += part * part * star[k] * star[k].transpose();
        ++count;
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(3 / count * sum);
    Eigen::Vector3d widths = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
    widths = widths.cwiseMax(least_length * widths.maxCoeff());
    whitening = solver.eigenvectors() * widths.cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
  }
  return whitening;
}

inline Normalization_3 normalization_of(const std::vector<Eigen::Vector3d>& points,
                                        const std::vector<Data_points_3::Edge>& edges) {
  constexpr std::size_t most_stars = 5000;
  Normalization_3 result;
  if (points.empty()) return result;
  for (const auto& p : points) result.origin += p / double(points.size());
  double longest = 0;
  for (const auto& [i, j] : edges) longest = std::max(longest, (points[i] - points[j]).lpNorm<Eigen::Infinity>());
  if (!(longest > 0)) return result;
  std::vector<std::size_t> star_of(points.size(), most_stars);
  const auto centers = random_subset(points.size(), most_stars, 4);
  for (std::size_t k = 0; k < centers.size(); ++k) star_of[centers[k]] = k;
  std::vector<std::vector<Eigen::Vector3d>> stars(centers.size());
  for (const auto& [i, j] : edges) {
    const Eigen::Vector3d edge = (points[i] - points[j]) / longest;
    for (const auto center : {i, j})
      if (star_of[center] < most_stars && !edge.isZero(0)) stars[star_of[center]].push_back(edge);
  }
  std::erase_if(stars, [](const auto& star) { return star.empty(); });
  if (!stars.empty()) result.matrix = whitening_of(stars) / longest;
  return result;
}

/// Data points in normal coordinates.
struct Normalized_data {
  Data_points_3 data;
  Normalization_3 normalization;
};

} // namespace equiaffine::internal

#endif
