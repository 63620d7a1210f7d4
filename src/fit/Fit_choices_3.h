// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses family, degree and radius of the fit around each point, by trials or for a scale.
#ifndef EQUIAFFINE_SRC_FIT_FIT_CHOICES_3_H
#define EQUIAFFINE_SRC_FIT_FIT_CHOICES_3_H

#include "fit/Data_points_3.h"
#include "fit/Fitted_numbers.h"
#include "fit/Local_fit_3.h"
#include "fit/fit_height.h"
#include "fit/fit_space.h"
#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/fit/Fit_options.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The parameters of a fit.
struct Way_to_fit {
  Fit_family family = Fit_family::HEIGHT;
  int degree = 4;
  double radius = 0; ///< in spacings of the points, or a length at a scale
  double weight_of_normals = 0;

  /// Whether this differs from the other only by a ball that is enough smaller to give independent information.
  bool is_smaller(const Way_to_fit& other) const {
    constexpr double ratio = 1.15;
    return family == other.family && degree == other.degree && weight_of_normals == other.weight_of_normals &&
           ratio * radius < other.radius;
  }

  /// The degree used for comparison.
  int other_degree() const { return degree + (family == Fit_family::HEIGHT ? 2 : 1); }

  /// Another degree for comparison. If a ball in space contains most of a centrally symmetric shape, odd degrees add
  /// nothing to even ones, so both agree regardless of their error. The highest degree has no such other degree.
  int other_degree_of_same_parity() const {
    return family == Fit_family::HEIGHT || degree + 2 <= maximal_space_degree ? degree + 2 : other_degree();
  }

  bool has_made(const Local_fit_3& fit, int of_degree) const {
    return fit.patch.family == family && fit.patch.degree == of_degree && fit.weight_of_normals == weight_of_normals;
  }
};

/// Returns the differences between the numbers of two fits, relative to the sizes of the first.
inline Number_errors relative_difference(const Fitted_numbers& fit, const Fitted_numbers& other) {
  return fit.differences(other) / fit.sizes();
}

/// The factor on standard deviations for the part of the residual beyond the noise, which is an error common to
/// whole regions.
inline double guard(const Local_fit_3& fit, double noise) {
  const double square = fit.residual * fit.residual;
  const double excess = square > 0 ? std::max(0., square - noise * noise) / square : 0;
  const double freedom = fit.patch.family == Fit_family::HEIGHT
                             ? double(number_of_coefficients(Fit_family::HEIGHT, fit.patch.degree))
                             : double((fit.patch.degree + 1) * (fit.patch.degree + 1));
  return std::sqrt(1 - excess + excess * std::max(1., double(fit.points) / freedom));
}

/// Returns relative errors, with 1 for numbers that do not exist.
inline Number_errors errors_or_all(const Number_errors& relative) {
  return relative.unaryExpr([](double error) { return std::isfinite(error) ? error : 1; });
}

/// The chosen fit parameters around a point.
struct Fit_choice {
  Way_to_fit way;
  Number_errors level = Number_errors::Zero(); ///< typical relative errors around the point
  double noise = 0;                            ///< standard deviation of points from any smooth surface
};

/// Chooses fit parameters around every point from the data if no scale is given. Trial fits at sample centers are
/// scored by an estimate of their errors, from the difference to the next degree and from the residuals. Scores are
/// averaged over neighboring centers, and the lowest score wins.
class Fit_trials_3 {
public:
  using Index = Data_points_3::Index;

  Fit_trials_3(bool in_threads, const Data_points_3& data, const Fit_options& options)
      : data_(data), options_(options), centers_(random_subset<Index>(data.size(), number_of_centers(data.size()), 1)),
        tree_(elements_at(data.points, centers_)) {
    list_candidates();
    trials_.resize(centers_.size());
    parallel_for(in_threads, 0, centers_.size(), [&](std::size_t c) { try_heights(c); });
    choices_.resize(centers_.size());
    for (std::size_t c = 0; c < centers_.size(); ++c) choices_[c] = choice_at(c);
    std::vector<std::size_t> doubtful;
    for (std::size_t c = 0; c < centers_.size(); ++c)
      if (!choices_[c] || choices_[c]->level[AFFINE_GAUSSIAN] > doubtful_level) doubtful.push_back(c);
    parallel_for(in_threads, 0, doubtful.size(), [&](std::size_t k) { try_spaces(doubtful[k]); });
    for (const std::size_t c : doubtful) choices_[c] = choice_at(c);
    for (const std::size_t c : doubtful)
      if (!choices_[c]) choices_[c] = choice_around(c);
  }

  const std::vector<Index>& centers() const { return centers_; }

  /// Returns the choice of the center nearest to the point, or of one near it if no fit is possible there.
  const std::optional<Fit_choice>& at(const Eigen::Vector3d& p) const { return choices_[tree_.nearest(p, 1).front()]; }

private:
  /// The numbers of a candidate at a center, with their errors.
  struct Measurement {
    Fitted_numbers numbers;
    double score;            ///< logarithm of the relative error of K
    Number_errors log_level; ///< logarithms of relative errors that include the degree of the same parity
    Fitted_curvatures deviations;
  };

  struct Trial {
    std::vector<std::optional<Measurement>> measurements; ///< one per candidate
    double noise = 0;
  };

  /// Polynomials in space take most of the time, so they are tried only where heights have a larger relative error
  /// of K.
  static constexpr double doubtful_level = 3e-3;

  /// A search ends after three consecutive radii whose error exceeds the smallest one by this factor.
  static constexpr double much_worse = 20;

  /// The weight of the standard deviation relative to the difference to another degree, from the prototype. It was
  /// tried on metaballs and a product of sines with noise of 0.1 to 5 % of an edge, and not varied since.
  static constexpr double weight_of_deviation = 1.4;

  static constexpr std::size_t number_around = 12; ///< of centers that are compared

  static constexpr std::array<int, 5> height_degrees_ = {4, 6, 8, 10, 12};
  static constexpr std::array<int, 4> space_degrees_ = {4, 5, 6, 7};
  static constexpr std::array<double, 2> weights_of_normals_ = {0.3, 0.03};

  void list_candidates() {
    for (double radius = 3; radius < 60; radius *= radius < 8 ? 1.1 : 1.2) radii_.push_back(radius);
    for (std::size_t r = 0; r < radii_.size(); ++r) {
      for (const int degree : {4, 6, 8, 10})
        if (!options_.degree || degree == *options_.degree)
          candidates_.push_back({Fit_family::HEIGHT, degree, radii_[r], 0});
      if (!is_radius_of_spaces(r)) continue;
      for (const int degree : {4, 5, 6})
        if (!options_.degree || degree == *options_.degree)
          for (const double weight : weights_of_normals_)
            candidates_.push_back({Fit_family::SPACE, degree, radii_[r], weight});
    }
  }

  bool is_radius_of_spaces(std::size_t r) const { return radii_[r] > 5 && r % 2 == 0; }

  static std::size_t number_of_centers(std::size_t points) {
    return std::min(points, std::clamp<std::size_t>(points / 50, 50, 200));
  }

  /// Returns the smallest residual of small overdetermined fits: the deviation from any smooth surface.
  double noise_at(Index center) const {
    if (options_.noise) return *options_.noise;
    double noise = std::numeric_limits<double>::infinity();
    for (const double multiple : {4., 5.5, 7.5})
      for (const auto& fit : fit_heights(data_, center, multiple * data_.spacing[center], height_degrees_))
        if (double(fit.points) > 1.5 * double(fit.patch.coefficients.size()) + 10)
          noise = std::min(noise, fit.residual);
    return std::isfinite(noise) ? noise : 0;
  }

  /// Tries fits of increasing radius until three in a row are much worse than the best, or no more points are added.
  template <class Fit>
  void try_radii(Trial& trial, std::size_t most_points, Fit fit) const {
    double least = std::numeric_limits<double>::infinity();
    int worse = 0;
    std::size_t points = 0;
    for (std::size_t r = 0; r < radii_.size() && worse < 3; ++r) {
      const std::vector<Local_fit_3> fits = fit(r);
      if (fits.empty()) continue;
      if (fits.front().points == points) break;
      points = fits.front().points;
      const double score = enter(trial, radii_[r], fits);
      least = std::min(least, score);
      worse = score > least + std::log(much_worse) ? worse + 1 : 0;
      if (points >= most_points) break;
    }
  }

  double length(std::size_t r, Index center) const { return radii_[r] * data_.spacing[center]; }

  void try_heights(std::size_t c) {
    Trial& trial = trials_[c];
    trial.measurements.resize(candidates_.size());
    trial.noise = noise_at(centers_[c]);
    try_radii(trial, 4000,
              [&](std::size_t r) { return fit_heights(data_, centers_[c], length(r, centers_[c]), height_degrees_); });
  }

  void try_spaces(std::size_t c) {
    try_radii(trials_[c], 2000, [&](std::size_t r) {
      return is_radius_of_spaces(r)
                 ? fit_spaces(data_, centers_[c], length(r, centers_[c]), space_degrees_, weights_of_normals_)
                 : std::vector<Local_fit_3>();
    });
  }

  /// Scores the candidates of one radius, and returns the lowest score.
  double enter(Trial& trial, double radius, const std::vector<Local_fit_3>& fits) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const Way_to_fit& candidate = candidates_[k];
      if (candidate.radius != radius) continue;
      const Local_fit_3 *fit = nullptr, *other = nullptr, *same_parity = nullptr;
      for (const auto& f : fits) {
        if (candidate.has_made(f, candidate.degree)) fit = &f;
        if (candidate.has_made(f, candidate.other_degree())) other = &f;
        if (candidate.has_made(f, candidate.other_degree_of_same_parity())) same_parity = &f;
      }
      if (fit == nullptr || other == nullptr) continue;
      if (candidate.family == Fit_family::SPACE && fit->residual > 2 * trial.noise) continue;
      const Fitted_numbers numbers = numbers_of(*fit);
      Number_errors difference = relative_difference(numbers, numbers_of(*other));
      const double score = logarithms(*fit, difference, trial.noise)[AFFINE_GAUSSIAN];
      if (same_parity != nullptr) difference = difference.max(relative_difference(numbers, numbers_of(*same_parity)));
      trial.measurements[k] = Measurement{numbers, score, logarithms(*fit, difference, trial.noise), fit->deviations};
      least = std::min(least, score);
    }
    return least;
  }

  /// Returns logarithms of relative errors, from differences to other fits, and for K and H also from the standard
  /// deviation.
  static Number_errors logarithms(const Local_fit_3& fit, const Number_errors& differences, double noise) {
    const double weight = weight_of_deviation * guard(fit, noise), size = fit.curvatures.size();
    Number_errors errors = differences;
    errors[AFFINE_GAUSSIAN] = std::hypot(errors[AFFINE_GAUSSIAN], weight * fit.deviations.gaussian / size);
    errors[AFFINE_MEAN] = std::hypot(errors[AFFINE_MEAN], weight * fit.deviations.mean / std::sqrt(size));
    return (errors_or_all(errors) + 1e-12).log();
  }

  /// The numbers in the coordinates of the data.
  static Fitted_numbers numbers_of(const Local_fit_3& fit) {
    return Jets_of_data(fit.patch.frame / fit.patch.radius).numbers(fit.jet);
  }

  /// The typical relative difference, over the centers around, between a number of a candidate and that in a smaller
  /// ball, without the contribution of noise to the latter.
  double difference_to_smaller(const std::vector<Index>& around, std::size_t candidate, std::size_t smaller,
                               Fitted_number number, double Fitted_curvatures::*deviation) const {
    constexpr double part_of_noise = 2 * 0.53, least = 1e-12; // twice that of the mean logarithm of normal errors
    double log_difference = 0, log_deviation = 0, count = 0;
    for (const Index d : around) {
      const auto &large = trials_[d].measurements[candidate], &small = trials_[d].measurements[smaller];
      if (!large || !small) continue;
      const double size = large->numbers.sizes()[number], part = small->deviations.*deviation / size;
      const double difference = std::abs(large->numbers.components[number] - small->numbers.components[number]) / size;
      if (!std::isfinite(difference) || !std::isfinite(part)) continue; // as on planes
      log_difference += std::log(difference + least);
      log_deviation += std::log(part + least);
      ++count;
    }
    if (count < 0.5 * double(around.size())) return 0;
    const double difference = std::exp(log_difference / count), noise = part_of_noise * std::exp(log_deviation / count);
    return std::sqrt(std::max(0., difference * difference - noise * noise));
  }

  /// The ratio of the errors of a candidate to `level`, the errors from differences between degrees. Where all
  /// degrees miss the same detail, a smaller ball reveals it (Lepski, On a problem of adaptive estimation in
  /// Gaussian white noise, 1991).
  double factor_by_smaller_balls(const std::vector<Index>& around, std::size_t candidate,
                                 const Number_errors& level) const {
    double factor = 1;
    for (std::size_t s = 0; s < candidate; ++s) {
      if (!candidates_[s].is_smaller(candidates_[candidate])) continue;
      const double of_affine =
          difference_to_smaller(around, candidate, s, AFFINE_GAUSSIAN, &Fitted_curvatures::gaussian);
      const double of_euclidean = difference_to_smaller(around, candidate, s, GAUSSIAN, &Fitted_curvatures::euclidean);
      factor = std::max({factor, of_affine / level[AFFINE_GAUSSIAN], of_euclidean / level[GAUSSIAN]});
    }
    return factor;
  }

  /// Skips candidates that fail at most centers around, unless none is left. On exact data smaller balls do not
  /// count, because differences between degrees are small compared with those between balls.
  std::optional<Fit_choice> choice_at(std::size_t c) const {
    const bool is_exact = trials_[c].noise <= noise_of_exact_data * data_.spacing[centers_[c]];
    const auto around = tree_.nearest(data_.points[centers_[c]], number_around);
    for (const double part : {0.7, 0.}) {
      std::optional<Fit_choice> best;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < candidates_.size(); ++k) {
        if (!trials_[c].measurements[k]) continue;
        double score = 0, count = 0;
        Number_errors level = Number_errors::Zero();
        for (const Index d : around) {
          if (const auto& measurement = trials_[d].measurements[k]) {
            score += measurement->score;
            level += measurement->log_level;
            ++count;
          }
        }
        if (count < part * double(around.size()) || score / count >= least) continue;
        level = (level / count).exp();
        const double factor = is_exact ? 1 : factor_by_smaller_balls(around, k, level);
        score /= count;
        if (factor > 1) score = std::log(std::hypot(std::exp(score), factor * level[AFFINE_GAUSSIAN]));
        if (score >= least) continue;
        least = score;
        best = Fit_choice{candidates_[k], factor * level, trials_[c].noise};
      }
      if (best) return best;
    }
    return {};
  }

  /// The choice of the nearest center that has one.
  std::optional<Fit_choice> choice_around(std::size_t c) const {
    for (const Index d : tree_.nearest(data_.points[centers_[c]], number_around))
      if (choices_[d]) return choices_[d];
    return {};
  }

  const Data_points_3& data_;
  Fit_options options_;
  std::vector<double> radii_;
  std::vector<Way_to_fit> candidates_;
  std::vector<Index> centers_;
  Point_tree_3 tree_; ///< of the centers
  std::vector<Trial> trials_;
  std::vector<std::optional<Fit_choice>> choices_;
};

/// The fit parameters around every point: by trials, or for one scale for all.
class Fit_choices_3 {
public:
  /// For the curvature of the surface itself, by trials. `matrix` maps the data to normalized coordinates.
  Fit_choices_3(const Data_points_3& data, const Eigen::Matrix3d& matrix, const Fit_options& options,
                Fit_trials_3 trials)
      : data_(data), matrix_(matrix), options_(options), trials_(std::move(trials)) {}

  /// For curvature at a scale, set by `set_scale`. `noise` is the deviation of every point from a smooth surface.
  Fit_choices_3(const Data_points_3& data, const Eigen::Matrix3d& matrix, const Fit_options& options,
                std::vector<double> noise)
      : data_(data), matrix_(matrix), options_(options), noise_(std::move(noise)) {}

  /// By definition, curvatures at a scale are those of a polynomial. Its default degree is the lowest one, which
  /// minimizes the effect of noise; degrees 8 and 10 are heights. The weight of normals is small, because noise of
  /// the points affects normals by more than their number averages out: with 0.3, K was off by four standard
  /// deviations where the noise was a tenth of an edge. The ball is larger in return, so that the scale means the
  /// same resolution as with that weight.
  void set_scale(double scale) {
    constexpr double weight_of_normals = 0.03;
    const int degree = options_.degree.value_or(4);
    const bool is_space = degree <= 6;
    scale_ = scale;
    at_scale_ = Fit_choice{{is_space ? Fit_family::SPACE : Fit_family::HEIGHT, degree, radius_of_scale * scale,
                            is_space ? weight_of_normals : 0}};
  }

  /// Returns the choice at a point, if a fit is possible there.
  const std::optional<Fit_choice>& at(const Eigen::Vector3d& p) const { return trials_ ? trials_->at(p) : at_scale_; }

  /// Returns the radius of a candidate around a point.
  double radius(const Way_to_fit& candidate, Data_points_3::Index center) const {
    return scale_ ? candidate.radius : candidate.radius * data_.spacing[center];
  }

  /// The scale of the curvatures, a length in normalized coordinates; nothing if they are those of the surface
  /// itself.
  const std::optional<double>& scale() const { return scale_; }

  bool is_scale_by_data() const { return !options_.scale; }

  bool has_noise() const { return options_.noise.has_value(); }

  /// The deviation of a point from a smooth surface. Without a scale it is that of the choice around the point.
  double noise(const Fit_choice& choice, Data_points_3::Index center) const {
    return noise_.empty() ? choice.noise : noise_[center];
  }

  Number_request number_request() const { return {matrix_, noise_, has_noise()}; }

private:
  /// The ratio of the radius of a ball to the scale.
  static constexpr double radius_of_scale = 1.14;

  const Data_points_3& data_;
  Eigen::Matrix3d matrix_;
  Fit_options options_;
  std::optional<Fit_trials_3> trials_;
  std::optional<double> scale_;
  std::optional<Fit_choice> at_scale_;
  std::vector<double> noise_;
};

} // namespace equiaffine::internal

#endif
