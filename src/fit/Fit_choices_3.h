// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_FIT_CHOICES_3_H
#define EQUIAFFINE_SRC_FIT_FIT_CHOICES_3_H

#include "fit/Data_points_3.h"
#include "fit/Fit_trials_3.h"
#include <equiaffine/fit/internal/Fit_request.h>

#include <Eigen/Core>

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// How the data are fitted around every point: as trials say, or at one scale for all.
class Fit_choices_3 {
public:
  /// The surface's own curvature, as trials say. `matrix` goes from the data to their normal coordinates.
  Fit_choices_3(const Data_points_3& data, const Eigen::Matrix3d& matrix, const Fit_request& request,
                Fit_trials_3 trials)
      : data_(data), matrix_(matrix), request_(request), trials_(std::move(trials)) {}

  /// Curvature at a scale, which `set_scale` sets. `noise` has the deviation of every point from a smooth surface.
  Fit_choices_3(const Data_points_3& data, const Eigen::Matrix3d& matrix, const Fit_request& request,
                std::vector<double> noise)
      : data_(data), matrix_(matrix), request_(request), noise_(std::move(noise)) {}

  /// At a scale curvatures are by definition those of a polynomial whose degree, the least one, makes the least of
  /// noise; one of degree 8 or 10 is a height. The weight of normals is small, since noise of the points makes normals
  /// wrong by more than their number evens out: with 0.3, K was off by four of its standard deviations where the noise
  /// was a tenth of an edge. The ball is larger for it, so that the scale means the same resolution as with that weight.
  void set_scale(double scale) {
    constexpr double weight_of_normals = 0.03;
    const int degree = request_.degree.value_or(4);
    const bool is_space = degree <= 6;
    scale_ = scale;
    at_scale_ = Fit_choice{{is_space ? Fit_family::SPACE : Fit_family::HEIGHT, degree, radius_of_scale * scale,
                            is_space ? weight_of_normals : 0}};
  }

  /// Returns the choice at a point, if any fit is possible there.
  const std::optional<Fit_choice>& at(const Eigen::Vector3d& p) const { return trials_ ? trials_->at(p) : at_scale_; }

  /// Returns the radius of a candidate around a point.
  double radius(const Way_to_fit& candidate, Data_points_3::Index center) const {
    return scale_ ? candidate.radius : candidate.radius * data_.spacing[center];
  }

  /// The scale of the curvatures, a length in normal coordinates; nothing for the surface's own.
  const std::optional<double>& scale() const { return scale_; }

  bool is_scale_by_data() const { return !request_.scale; }

  bool has_noise() const { return request_.noise.has_value(); }

  /// The deviation of a point from a smooth surface, which the choice around it has without a scale.
  double noise(const Fit_choice& choice, Data_points_3::Index center) const {
    return noise_.empty() ? choice.noise : noise_[center];
  }

  Number_request number_request() const { return {matrix_, noise_, has_noise()}; }

private:
  /// The radius of a ball beside the scale.
  static constexpr double radius_of_scale = 1.14;

  const Data_points_3& data_;
  Eigen::Matrix3d matrix_;
  Fit_request request_;
  std::optional<Fit_trials_3> trials_;
  std::optional<double> scale_;
  std::optional<Fit_choice> at_scale_;
  std::vector<double> noise_;
};

} // namespace equiaffine::internal

#endif
