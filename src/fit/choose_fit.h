// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_CHOOSE_FIT_H
#define EQUIAFFINE_SRC_FIT_CHOOSE_FIT_H

#include "fit/Curvature_fit_3.h"
#include "fit/Fit_choices_3.h"
#include "fit/Normalization_3.h"
#include "fit/check_scale.h"
#include "fit/point_noise.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/internal/random_subset.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Whether noise leaves K of a fit at a scale known to within a part of |K| + H^2.
inline bool is_gaussian_known(const Curvature_fit_3& fit, double part) {
  const auto& numbers = fit.numbers.components;
  const double size = std::abs(numbers[AFFINE_GAUSSIAN]) + numbers[AFFINE_MEAN] * numbers[AFFINE_MEAN];
  return std::isfinite(fit.accuracy.error[AFFINE_GAUSSIAN]) &&
         fit.accuracy.noise[AFFINE_GAUSSIAN] * fit.numbers.sizes()[AFFINE_GAUSSIAN] <= part * size;
}

/// Whether the surface of a fit is flat along a direction, within the error: it has no affine curvature to be known.
inline bool is_flat(const Curvature_fit_3& fit) {
  const Number_errors sizes = fit.numbers.sizes();
  return std::abs(fit.numbers.components[GAUSSIAN]) <= fit.accuracy.error[GAUSSIAN] * sizes[GAUSSIAN] &&
         fit.accuracy.error[GAUSSIAN] <= 0.01;
}

/// Returns the part of centers at which `is_settled(fit)` holds.
template <class Is_settled>
double part_settled(bool in_threads, const Data_points_3& data, const Fit_choices_3& choices,
                    const std::vector<Data_points_3::Index>& centers, const Is_settled& is_settled) {
  std::vector<char> settled(centers.size());
  parallel_for(in_threads, 0, centers.size(), [&](std::size_t c) {
    const auto& choice = choices.at(data.points[centers[c]]);
    const auto fit = choice ? curvature_fit(data, centers[c], *choice, choices, Fit_use::BLEND) : std::nullopt;
    settled[c] = fit && is_settled(*fit);
  });
  return centers.empty() ? 1 : double(std::count(settled.begin(), settled.end(), 1)) / double(centers.size());
}

/// The diagonal of the box of points along their principal axes: in normal coordinates it is the same for all affine
/// images of the points, but where axes are not determined.
inline double principal_diagonal(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p / double(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto& p : points) spread += (p - mean) * (p - mean).transpose();
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().transpose();
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const auto& p : points) {
    lower = lower.cwiseMin(axes * p);
    upper = upper.cwiseMax(axes * p);
  }
  return points.empty() ? 0 : (upper - lower).norm();
}

/// Sets the smallest scale at which noise leaves K known to 20 % at half of the points, from 1/64 to 1/8 of the diagonal;
/// or the largest of these, where it never does.
inline void set_known_scale(bool in_threads, const Normalized_data& normalized, Fit_choices_3& choices) {
  const Data_points_3& data = normalized.data;
  constexpr std::size_t most_centers = 200;
  constexpr int quarters_of_octave = 12;
  const auto centers = random_subset<Data_points_3::Index>(data.size(), std::min(data.size(), most_centers), 3);
  const double greatest =
      std::min(principal_diagonal(data.points), normalized.normalization.scale() * diagonal_of_data(normalized)) / 8;
  for (int step = quarters_of_octave; step >= 0; --step) {
    choices.set_scale(greatest * std::pow(2, -0.25 * step));
    if (step > 0 && part_settled(in_threads, data, choices, centers,
                                 [](const auto& fit) { return is_gaussian_known(fit, 0.2); }) >= 0.5)
      return;
  }
}

/// Chooses how to fit. A scale of 0 asks for the surface's own curvature. Without a scale that is chosen where K is
/// known to 50 % at half of the points, or does not exist since the surface is flat.
inline Fit_choices_3 choose_fit(bool in_threads, const Normalized_data& normalized, const Fit_request& request) {
  const Data_points_3& data = normalized.data;
  const Eigen::Matrix3d& matrix = normalized.normalization.matrix;
  if (!request.scale || *request.scale == 0) {
    Fit_trials_3 trials(in_threads, data, request);
    const auto centers = trials.centers();
    Fit_choices_3 own(data, matrix, request, std::move(trials));
    const auto is_settled = [](const Curvature_fit_3& fit) {
      return fit.accuracy.error[AFFINE_GAUSSIAN] <= 0.5 || is_flat(fit);
    };
    if (request.scale || part_settled(in_threads, data, own, centers, is_settled) >= 0.5) return own;
  }
  auto noise = request.noise ? std::vector<double>(data.size(), *request.noise) : point_noise(in_threads, data);
  Fit_choices_3 at_scale(data, matrix, request, std::move(noise));
  if (!request.scale) {
    set_known_scale(in_threads, normalized, at_scale);
    return at_scale;
  }
  at_scale.set_scale(*request.scale);
  check_scale(normalized, at_scale);
  return at_scale;
}

} // namespace equiaffine::internal

#endif
