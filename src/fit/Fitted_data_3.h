// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses the scale of a fit, and computes the local structures with estimated errors.
#ifndef EQUIAFFINE_SRC_FIT_FITTED_DATA_3_H
#define EQUIAFFINE_SRC_FIT_FITTED_DATA_3_H

#include "fit/Curvature_fit_3.h"
#include "fit/Data_points_3.h"
#include "fit/Fit_choices_3.h"
#include "fit/Fitted_numbers.h"
#include "fit/fit_height.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/Linear_substitution_3.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The standard deviation of the points around one from a small height of degree 4: the deviation from any smooth
/// surface. NaN where there are too few points.
inline double noise_at_point(const Data_points_3& data, Data_points_3::Index center) {
  constexpr int degree = 4;
  constexpr double radius_in_spacings = 6, growth = 1.2;
  constexpr std::size_t enough = 33; // points: twice the number of coefficients, and a few more
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

/// The noise at every point; the mean of the others where it is unknown.
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

/// The diagonal of the bounding box of the data.
inline double diagonal_of_data(const Normalized_data& normalized) {
  const Eigen::Matrix3d inverse = normalized.normalization.matrix.inverse();
  Eigen::AlignedBox3d box;
  for (const auto& p : normalized.data.points) box.extend(inverse * p);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// Whether the ball of the scale has enough points for a polynomial at half of the sample centers.
inline bool has_enough_points(const Data_points_3& data, const std::vector<Data_points_3::Index>& centers,
                              const Fit_choices_3& choices) {
  const Way_to_fit& way = choices.at(Eigen::Vector3d::Zero())->way;
  const std::array degree = {way.degree};
  const auto enough = std::count_if(centers.begin(), centers.end(), [&](auto i) {
    return greatest_degree(way.family, degree, connected_ball(data, i, way.radius).size()) > 0;
  });
  return 2 * std::size_t(enough) >= centers.size();
}

/// Rejects a scale larger than a third of the size of the data, and one with too few points at most centers.
inline void check_scale(const Normalized_data& normalized, Fit_choices_3 choices) {
  const Data_points_3& data = normalized.data;
  const Way_to_fit way = choices.at(Eigen::Vector3d::Zero())->way;
  if (greatest_degree(way.family, std::array{way.degree}, data.size()) == 0) return; // there is no fit then
  const double unit = normalized.normalization.scale(), scale = *choices.scale() / unit;
  const double diagonal = diagonal_of_data(normalized);
  const double unit_of_third_digit = std::pow(10, std::floor(std::log10(diagonal)) - 3);
  const auto text = [](const auto&... words) {
    std::ostringstream stream;
    stream.precision(3);
    (stream << ... << words);
    return stream.str();
  };
  if (scale > diagonal / 3)
    throw Input_error::about("scale", text("the scale ", scale, " is more than a third of the size ", diagonal,
                                           " of the data; give at most ",
                                           std::floor(diagonal / 3 / unit_of_third_digit) * unit_of_third_digit));
  constexpr std::size_t most_centers = 200;
  const auto centers = random_subset<Data_points_3::Index>(data.size(), std::min(data.size(), most_centers), 3);
  double least = scale;
  for (; !has_enough_points(data, centers, choices) && least < diagonal; least *= 1.1)
    choices.set_scale(1.1 * least * unit);
  if (least != scale && least < diagonal / 3)
    throw Input_error::about("scale", text("most points have too few neighbors for a polynomial within the scale ",
                                           scale, "; give at least ",
                                           std::ceil(least / unit_of_third_digit) * unit_of_third_digit));
}

/// Whether K of a fit at a scale is known, despite noise, to within a fraction of |K| + H^2.
inline bool is_gaussian_known(const Curvature_fit_3& fit, double part) {
  const auto& numbers = fit.numbers.components;
  const double size = std::abs(numbers[AFFINE_GAUSSIAN]) + numbers[AFFINE_MEAN] * numbers[AFFINE_MEAN];
  return std::isfinite(fit.accuracy.error[AFFINE_GAUSSIAN]) &&
         fit.accuracy.noise[AFFINE_GAUSSIAN] * fit.numbers.sizes()[AFFINE_GAUSSIAN] <= part * size;
}

/// Whether the surface of a fit is flat along a direction, within the error, so that it has no affine curvature.
inline bool is_flat(const Curvature_fit_3& fit) {
  const Number_errors sizes = fit.numbers.sizes();
  return std::abs(fit.numbers.components[GAUSSIAN]) <= fit.accuracy.error[GAUSSIAN] * sizes[GAUSSIAN] &&
         fit.accuracy.error[GAUSSIAN] <= 0.01;
}

/// Returns the fraction of centers at which `is_settled(fit)` holds.
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

/// The diagonal of the bounding box of points along their principal axes. In normalized coordinates it is the same
/// for all affine images of the points, unless the axes are not determined.
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

/// Sets the smallest scale, from 1/64 to 1/8 of the diagonal, at which K is known to 20 % despite noise at half of
/// the points; or the largest one if there is none.
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

/// Chooses fit parameters. A scale of 0 requests the curvature of the surface itself. Without a scale this is chosen
/// if K is known to 50 % at half of the points, or does not exist because the surface is flat.
inline Fit_choices_3 choose_fit(bool in_threads, const Normalized_data& normalized, const Fit_options& options) {
  const Data_points_3& data = normalized.data;
  const Eigen::Matrix3d& matrix = normalized.normalization.matrix;
  if (!options.scale || *options.scale == 0) {
    Fit_trials_3 trials(in_threads, data, options);
    const auto centers = trials.centers();
    Fit_choices_3 own(data, matrix, options, std::move(trials));
    const auto is_settled = [](const Curvature_fit_3& fit) {
      return fit.accuracy.error[AFFINE_GAUSSIAN] <= 0.5 || is_flat(fit);
    };
    if (options.scale || part_settled(in_threads, data, own, centers, is_settled) >= 0.5) return own;
  }
  auto noise = options.noise ? std::vector<double>(data.size(), *options.noise) : point_noise(in_threads, data);
  Fit_choices_3 at_scale(data, matrix, options, std::move(noise));
  if (!options.scale) {
    set_known_scale(in_threads, normalized, at_scale);
    return at_scale;
  }
  at_scale.set_scale(*options.scale);
  check_scale(normalized, at_scale);
  return at_scale;
}

/// Data points with their fit parameters. Not movable, because the choices refer to the data.
class Fitted_data_3 {
public:
  Fitted_data_3(bool in_threads, Normalized_data data, Fit_options options)
      : data_(std::move(data)), greatest_coordinate_(greatest_coordinate(data_)),
        choices_(choose_fit(in_threads, data_, in_normal_coordinates(options))), substitution_(matrix()) {}

  Fitted_data_3(const Fitted_data_3&) = delete;
  Fitted_data_3& operator=(const Fitted_data_3&) = delete;

  const Data_points_3& data() const { return data_.data; }
  const Fit_choices_3& choices() const { return choices_; }
  /// The scale of the curvatures in the unit of the data; nothing if they are those of the surface itself.
  std::optional<double> scale() const {
    if (!choices_.scale()) return {};
    return *choices_.scale() / data_.normalization.scale();
  }
  const Normalization_3& normalization() const { return data_.normalization; }
  /// The diagonal of the bounding box of the data.
  double diagonal() const { return diagonal_of_data(data_); }

  /// Converts an expansion from normalized coordinates to those of the data, in their unit of length.
  template <int Order>
  Jet_3<double, Order> to_space(const Jet_3<double, Order>& jet) const {
    return substitution_(jet) * (1 / data_.normalization.scale());
  }

  /// The errors of second derivatives due to rounding of the points, for an expansion in the coordinates of the
  /// data.
  template <int Order>
  double rounding(const Jet_3<double, Order>& jet, double radius) const {
    const auto& c = jet.coefficients();
    const double units = std::numeric_limits<double>::epsilon() * greatest_coordinate_;
    const double length = radius / normalization().scale();
    return 1000 * units * std::hypot(c[1], c[2], c[3]) / (length * length);
  }

private:
  static double greatest_coordinate(const Normalized_data& data) {
    const Eigen::Matrix3d inverse = data.normalization.matrix.inverse();
    double greatest = 0;
    for (const auto& p : data.data.points)
      greatest = std::max(greatest, (data.normalization.origin + inverse * p).lpNorm<Eigen::Infinity>());
    return greatest;
  }

  Fit_options in_normal_coordinates(Fit_options options) const {
    if (options.noise) *options.noise *= data_.normalization.scale();
    if (options.scale) *options.scale *= data_.normalization.scale();
    return options;
  }

  Linear_substitution_3<double>::Matrix matrix() const {
    Linear_substitution_3<double>::Matrix rows;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) rows[i][j] = data_.normalization.matrix(Eigen::Index(i), Eigen::Index(j));
    return rows;
  }

  Normalized_data data_;
  double greatest_coordinate_;
  Fit_choices_3 choices_;
  Linear_substitution_3<double> substitution_;
};

/// The errors of second derivatives due to rounding. Infinity where K_e is zero within its estimated error and at
/// most that of a sphere with ten times the radius of the fit: a relative error can be large for any curvature.
inline double rounding_of(const Jet_3<double>& jet, const Fitted_data_3& fit, const Fit_accuracy& accuracy) {
  const Fitted_numbers numbers(jet);
  const double curvature = std::abs(numbers.components[GAUSSIAN]);
  const bool is_flat = curvature <= accuracy.error[GAUSSIAN] * numbers.sizes()[GAUSSIAN] &&
                       curvature * accuracy.radius * accuracy.radius <= 0.01;
  return is_flat ? std::numeric_limits<double>::infinity() : fit.rounding(fit.to_space(jet), accuracy.radius);
}

/// The errors of the existing numbers of a structure, from errors relative to their sizes. Angles are in degrees.
inline Local_structure_error_3<double> structure_error(const Number_errors& relative, const Number_errors& sizes,
                                                       Point_status status) {
  Number_errors e = relative * sizes;
  e.tail<2>() = (e.tail<2>() * (180 / std::numbers::pi)).min(180);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (status != Point_status::REGULAR) e[AFFINE_GAUSSIAN] = e[AFFINE_MEAN] = e[PICK] = e[AFFINE_NORMAL] = nan;
  if (status != Point_status::REGULAR && status != Point_status::PARABOLIC) e.setConstant(nan);
  return {{e[AFFINE_GAUSSIAN], e[AFFINE_MEAN]},
          e[PICK],
          e[AREA_DENSITY],
          e[AFFINE_NORMAL],
          e[NORMAL],
          e[GAUSSIAN],
          e[MEAN],
          e[K1],
          e[K2]};
}

inline Fitted_structure_3<double> structure_without_fit() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  auto structure = local_structure(Jet_3<double>(nan));
  structure.status = Point_status::OUTSIDE;
  const Local_structure_error_3<double> unknown =
      structure_error(Number_errors::Constant(nan), Number_errors::Ones(), structure.status);
  return {structure, unknown, unknown, unknown, nan, false, nan};
}

/// The structure of the level set through a point, from the expansion of a fit, or of a blend of fits, there.
inline Fitted_structure_3<double> structure_of(const Jet_3<double>& jet, const Fitted_data_3& fit,
                                               const Fit_accuracy& accuracy, Orientation_of_level_set orientation) {
  Fitted_structure_3<double> result;
  const double sign = orientation == Orientation_of_level_set::AGAINST_GRADIENT ? -1 : 1;
  result.structure = local_structure(fit.to_space(jet) * sign, {0, 0, 0}, rounding_of(jet, fit, accuracy));
  const Number_errors sizes = Fitted_numbers(fit.to_space(jet)).sizes();
  result.error = structure_error(accuracy.error, sizes, result.structure.status);
  result.noise = structure_error(accuracy.noise, sizes, result.structure.status);
  result.detail = structure_error(accuracy.detail, sizes, result.structure.status);
  result.scale = fit.scale().value_or(accuracy.radius / fit.normalization().scale());
  result.is_at_scale = fit.scale().has_value();
  result.deviation = accuracy.deviation / fit.normalization().scale();
  return result;
}

} // namespace equiaffine::internal

#endif
