// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_AREA_SAMPLES_3_H
#define EQUIAFFINE_SRC_REGISTRATION_AREA_SAMPLES_3_H

#include "registration/Affine_map_3.h"
#include "registration/Moments_3.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// Points that are uniform in the area of a surface, the first n of them, too, with unit normals to either side.
struct Area_samples_3 {
  std::vector<Eigen::Vector3d> points, normals;
  Moments_3 area;
  std::optional<Moments_3> volume = {}; ///< of a function whose surface bounds a solid
  double facet_error = 0; ///< the rms distance of the triangles from the smooth surface that they stand for
  double greatest_facet_error = 0;
  bool is_cut = false; ///< whether the surface ends at its box, so that symmetries of the whole keep no centroid

  double spacing() const { return std::sqrt(area.measure / double(points.size())); }

  /// The largest distance of a point from the origin.
  double radius() const {
    double result = 0;
    for (const Eigen::Vector3d& p : points) result = std::max(result, p.norm());
    return result;
  }
};

/// A random point of the ball with a radius around a surface is nearer to it than t with the probability of this times t.
inline double chance_of_nearness(double area, double radius) {
  return 2 * area / (4 * std::numbers::pi / 3 * std::pow(radius, 3));
}

/// The point n of a sequence of low discrepancy in a cube (M. Roberts, The unreasonable effectiveness of quasirandom
/// sequences, 2018).
template <std::size_t Dimension>
std::array<double, Dimension> quasirandom(std::size_t n) {
  static const double root = [] { // x^(d + 1) = x + 1 has it as its root, and this iteration as its limit
    double x = 1.5;
    for (int step = 0; step < 40; ++step) x = std::pow(1 + x, 1 / (1.0 + double(Dimension)));
    return x;
  }();
  std::array<double, Dimension> result;
  double x = double(n + 1);
  for (double& coordinate : result) {
    x /= root;
    coordinate = x + 0.5 - std::floor(x + 0.5);
  }
  return result;
}

/// The map to coordinates in which a measure has centroid 0 and covariance 1. Affine symmetries of the solid are
/// orthogonal there.
inline Affine_map_3 whitening_map(const Moments_3& moments) {
  const Eigen::Matrix3d factor = moments.covariance.llt().matrixL();
  const Eigen::Matrix3d matrix = factor.inverse();
  return {matrix, -(matrix * moments.centroid)};
}

/// The map to coordinates in which an area has centroid 0 and size 1.
inline Affine_map_3 centering_map(const Moments_3& area) {
  return {Eigen::Matrix3d::Identity() / area.size(), -area.centroid / area.size()};
}

} // namespace equiaffine::internal

#endif
