// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_FITTED_DATA_3_H
#define EQUIAFFINE_SRC_FIT_FITTED_DATA_3_H

#include "fit/Normalization_3.h"
#include "fit/choose_fit.h"
#include <equiaffine/number/internal/Linear_substitution_3.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Data points with the way to fit them. It stays where it is, since the choice refers to the data.
class Fitted_data_3 {
public:
  Fitted_data_3(bool in_threads, Normalized_data data, Fit_request request)
      : data_(std::move(data)), greatest_coordinate_(greatest_coordinate(data_)),
        choices_(choose_fit(in_threads, data_, in_normal_coordinates(request))), substitution_(matrix()) {}

  Fitted_data_3(const Fitted_data_3&) = delete;
  Fitted_data_3& operator=(const Fitted_data_3&) = delete;

  const Data_points_3& data() const { return data_.data; }
  const Fit_choices_3& choices() const { return choices_; }
  /// The scale of the curvatures in the unit of the data; nothing for the surface's own.
  std::optional<double> scale() const {
    if (!choices_.scale()) return {};
    return *choices_.scale() / data_.normalization.scale();
  }
  const Normalization_3& normalization() const { return data_.normalization; }
  /// The diagonal of the box of the data.
  double diagonal() const { return diagonal_of_data(data_); }

  /// Turns the expansion of a function in normal coordinates into one in those of the data, in their unit of length.
  template <int Order>
  Jet_3<double, Order> to_space(const Jet_3<double, Order>& jet) const {
    return substitution_(jet) * (1 / data_.normalization.scale());
  }

  /// The errors of second derivatives that roundings of the points make, for the expansion of a fit in space.
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

  Fit_request in_normal_coordinates(Fit_request request) const {
    if (request.noise) *request.noise *= data_.normalization.scale();
    if (request.scale) *request.scale *= data_.normalization.scale();
    return request;
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

} // namespace equiaffine::internal

#endif
