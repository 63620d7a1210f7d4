// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_POINT_NOISE_H
#define EQUIAFFINE_SRC_FIT_POINT_NOISE_H

#include "fit/Data_points_3.h"
#include "fit/fit_height.h"
#include <equiaffine/base/internal/parallel_for.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// The standard deviation of the points around one from a small height of degree 4: what no smooth surface explains. It
/// is not a number where there are too few points.
inline double noise_at_point(const Data_points_3& data, Data_points_3::Index center) {
  constexpr int degree = 4;
  constexpr double radius_in_spacings = 6, growth = 1.2;
  constexpr std::size_t enough = 33; // points: twice the number of coefficients, and some more
  double radius = radius_in_spacings * data.spacing[center];
  auto ball = connected_ball(data, center, radius);
  for (int step = 0; step < 4 && ball.size() < enough; ++step) ball = connected_ball(data, center, radius *= growth);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const auto i : ball) normal += data.normals[i];
  normal.normalize();
  const Height_system system = height_system(data, ball, radius, normal, degree);
  const auto count = double(system.rows.rows()), points = double(ball.size());
  if (points < count + 8) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::LLT<Eigen::MatrixXd> cholesky(system.rows * system.rows.transpose());
  const Eigen::VectorXd rest = system.heights - system.rows.transpose() * cholesky.solve(system.rows * system.heights);
  return radius * rest.norm() / std::sqrt(system.roots_of_weights.squaredNorm() * (1 - count / points));
}

/// The noise of every point; the mean of the others where it is not known.
inline std::vector<double> point_noise(bool in_threads, const Data_points_3& data) {
  std::vector<double> noise(data.size());
  parallel_for(
      in_threads, 0, data.size(), [&](std::size_t i) { noise[i] = noise_at_point(data, Data_points_3::Index(i)); }, 64);
  double sum = 0, known = 0;
  for (const double number : noise)
    if (std::isfinite(number)) {
      sum += number;
      ++known;
    }
  for (double& number : noise)
    if (!std::isfinite(number)) number = known > 0 ? sum / known : 0;
  return noise;
}

} // namespace equiaffine::internal

#endif
