// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_LOCAL_FIT_3_H
#define EQUIAFFINE_SRC_FIT_LOCAL_FIT_3_H

#include "fit/Data_points_3.h"
#include "fit/Fitted_numbers.h"
#include "fit/Patch_3.h"
#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/number/Jet_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

namespace equiaffine::internal {

struct Fitted_curvatures {
  double gaussian, mean; ///< the affine ones
  double euclidean;      ///< the Euclidean Gaussian curvature K_e

  /// The size that errors of K are compared with. It is not zero where K changes its sign, nor on a paraboloid, where K
  /// and H are zero: the last term is a part of K of a sphere with that Gaussian curvature.
  double size() const { return std::abs(gaussian) + mean * mean + 0.01 * std::pow(std::abs(euclidean), 1.5); }
};

inline Fitted_curvatures curvatures_of(const Jet_3<double>& jet) {
  const Monge_chart_3<double> chart(jet);
  const auto invariants = affine_invariants(chart);
  const double slope = 1 + chart.a * chart.a + chart.b * chart.b;
  return {invariants.gaussian_curvature, invariants.mean_curvature, chart.d() / (slope * slope)};
}

/// A request says how a fit estimates its numbers and their errors.
struct Number_request {
  Eigen::Matrix3d matrix;        ///< from the data to the coordinates of the points
  std::span<const double> noise; ///< the standard deviation of each point from a smooth surface; empty if not known
  bool is_given = false;         ///< whether a user gave the noise: then it counts as it is, whatever residuals are
};

/// The numbers of the data at the foot of the center of a fit, with standard deviations.
struct Number_estimates {
  Fitted_numbers numbers;
  Number_errors of_residual; ///< if residuals are white noise
  Number_errors of_noise;    ///< from the noise of every point, if that is known, or of the residual where this is less
};

/// A polynomial fitted to points, with the curvatures of its zero set at the foot of the center and what is known about
/// their errors.
struct Local_fit_3 {
  Patch_3 patch;
  Jet_3<double> jet = {}; ///< at the foot, in the frame of the patch and in radii
  Fitted_curvatures curvatures;
  Fitted_curvatures deviations = {}; ///< standard deviations if residuals are white noise
  double residual = 0;               ///< the standard deviation of one point from the zero set
  std::size_t points = 0;            ///< in the ball
  double weight_of_normals = 0;      ///< of a polynomial in space
  double least_cosine = 1;           ///< of the angles between the frame's third axis and the normals of the points
  std::optional<Number_estimates> estimates = {}; ///< if they were asked for
};

/// How numbers, one for each column, change with the coefficients of the jet.
using Number_gradient = Eigen::Matrix<double, int(Jet_3<double>::size), Eigen::Dynamic>;

/// The gradients of K, H and K_e, by central differences as in Jets_of_data.
inline Number_gradient curvature_gradient(const Jet_3<double>& jet) {
  Number_gradient gradient = Number_gradient::Zero(Eigen::Index(jet.size), 3);
  for (std::size_t n = 1; n < jet.size; ++n) {
    Jet_3<double> above = jet, below = jet;
    const double step = 1e-4 * std::max(0.01, std::abs(jet.coefficients()[n]));
    above.coefficients()[n] += step;
    below.coefficients()[n] -= step;
    const auto a = curvatures_of(above), b = curvatures_of(below);
    gradient.row(Eigen::Index(n)) << a.gaussian - b.gaussian, a.mean - b.mean, a.euclidean - b.euclidean;
    gradient.row(Eigen::Index(n)) /= 2 * step;
  }
  return gradient;
}

/// Curvatures for lengths in another unit, `unit` times as large.
inline Fitted_curvatures in_unit(const Fitted_curvatures& c, double unit) {
  const double volume = unit * unit * unit;
  return {c.gaussian / volume, c.mean / std::sqrt(volume), c.euclidean / (unit * unit)};
}

/// The estimates from how the numbers change where a point of the ball moves by a radius along its normal, a row of
/// `influence` for each point. The rows are `part` of those that there would be for all points of the ball.
inline Number_estimates number_estimates(const Fitted_numbers& numbers, const Eigen::MatrixXd& influence,
                                         double residual, const Eigen::VectorXd& noise, bool is_given, double part) {
  Number_estimates result{numbers, {}, {}};
  const double factor = 1 / std::sqrt(part);
  result.of_residual = residual * factor * numbers.deviations(influence);
  result.of_noise = result.of_residual;
  if (noise.size() > 0) result.of_noise = factor * numbers.deviations(noise.asDiagonal() * influence);
  if (!is_given) result.of_noise = result.of_noise.min(result.of_residual).eval();
  return result;
}

/// The noise of points in radii of a ball; empty if it is not known.
inline Eigen::VectorXd noise_in_radii(std::span<const double> noise, std::span<const Data_points_3::Index> ball,
                                      double radius) {
  Eigen::VectorXd result(noise.empty() ? 0 : Eigen::Index(ball.size()));
  for (Eigen::Index k = 0; k < result.size(); ++k) result[k] = noise[ball[std::size_t(k)]] / radius;
  return result;
}

} // namespace equiaffine::internal

#endif
