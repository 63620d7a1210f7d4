// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_PATCHES_3_H
#define EQUIAFFINE_SRC_FIT_PATCHES_3_H

#include "fit/Ball_tree_3.h"
#include "fit/Patch_cover_3.h"
#include "fit/Point_tree_3.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/fit/internal/Charts_3.h>
#include <equiaffine/number/Jet_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The mean of the patches around a point with weights (1 - |p - c|^2 / R^2)^6 / R^8, where c is the center of a patch and
/// R a part of its radius. The factor gives small patches, which know more, the say where those of sparser data overlap
/// with them. Derivatives are means with the same weights, as if these were constant: the diffuse derivatives of Nayroles,
/// Touzot and Villon (1992). Those of the weights would only add what patches disagree on, divided by powers of R. Each
/// smooth part of the surface has patches of its own.
///
/// Another sheet of a part may lie within R. Since a patch of that sheet is not to have a say on this one, its weight is
/// multiplied by (1 - (g / b)^2)^6, where g is its value and b is a part of the distance from its center to the nearest
/// point that is not connected with it.
class Patches_3 {
public:
  using Vector = Eigen::Vector3d;

  Patches_3(bool in_threads, const Data_points_3& data, const Fit_choices_3& choices) {
    auto cover = patch_cover(in_threads, data, choices, Fit_use::BLEND, reach * distance_of_centers);
    std::vector<Data_points_3::Index> centers;
    for (std::size_t k = 0; k < cover.centers.size(); ++k) {
      if (!cover.fits[k]) continue;
      centers.push_back(cover.centers[k]);
      radii_.push_back(reach * cover.fits[k]->patch.radius);
      charts_of_fits_.push_back(data.charts.of(cover.centers[k]));
      fits_.push_back(std::move(*cover.fits[k]));
    }
    const Point_tree_3 tree(data.points);
    for (const double radius : radii_) factors_.push_back(std::pow(radius, -power_of_radius));
    gates_.resize(fits_.size());
    parallel_for(in_threads, 0, fits_.size(),
                 [&](std::size_t k) { gates_[k] = gate(data, tree, centers[k], radii_[k]); });
    std::vector<Vector> places;
    for (const auto& fit : fits_) places.push_back(fit.patch.center);
    balls_ = Ball_tree_3(places, radii_);
  }

  /// The least radius of the fits that are blended at a point; infinity where there is none.
  double least_radius(const Vector& p, Charts_3::Index chart) const {
    double least = std::numeric_limits<double>::infinity();
    for_each_weight(p, chart,
                    [&](std::size_t k, double, double, double) { least = std::min(least, fits_[k].patch.radius); });
    return least;
  }

  /// A mean, and how far inside a patch the point is: 1 at its center, 0 where patches end.
  template <class T>
  struct Mean {
    T value;
    double depth;
  };

  /// The value, as far as patches reach; not a number without patches.
  Mean<double> value(const Vector& p, Charts_3::Index chart) const {
    double sum = 0, weights = 0, depth = 0;
    for_each_weight(p, chart, [&](std::size_t, double weight, double g, double root) {
      sum += weight * g;
      weights += weight;
      depth = std::max(depth, root);
    });
    return {sum / weights, depth};
  }

  /// The expansion, as far as patches reach.
  template <int Order>
  Mean<Jet_3<double, Order>> taylor(const Vector& p, Charts_3::Index chart) const {
    Jet_3<double, Order> sum(0.);
    double weights = 0, depth = 0;
    for_each_weight(p, chart, [&](std::size_t k, double weight, double, double root) {
      sum += fits_[k].patch.template taylor<Order>(p) * weight;
      weights += weight;
      depth = std::max(depth, root);
    });
    return {sum * (1 / weights), depth};
  }

  /// The accuracy of an expansion at a point: geometric means of the errors of the fits that are blended there, since
  /// these differ by orders of magnitude where K_e is about 0 for some of the fits. Where the curvatures of the expansion
  /// are larger than those of the fits, they are as uncertain relative to their own size.
  Fit_accuracy accuracy(const Vector& p, const Jet_3<double>& jet, Charts_3::Index chart) const {
    constexpr Eigen::Index n = number_of_fitted_numbers;
    using Numbers = Eigen::Array<double, 4 * n + 1, 1>;
    Numbers sum = Numbers::Zero();
    double weights = 0, least = std::numeric_limits<double>::infinity();
    for_each_weight(p, chart, [&](std::size_t k, double weight, double, double) {
      const auto& [error, noise, detail, radius, deviation] = fits_[k].accuracy;
      least = std::min(least, radius);
      Numbers numbers;
      numbers << error, noise, detail, Fitted_numbers(fits_[k].patch.taylor(p)).sizes(), deviation;
      sum += weight * numbers.log();
      weights += weight;
    });
    Numbers mean = (sum / weights).exp();
    for (double& number : mean)
      if (number < std::numeric_limits<double>::min()) number = 0; // the exponential of minus infinity is not quite 0
    const Number_errors factor = (mean.segment<n>(3 * n) / Fitted_numbers(jet).sizes()).max(1);
    return {mean.segment<n>(0) * factor, mean.segment<n>(n) * factor, mean.segment<n>(2 * n) * factor, least,
            mean[4 * n]};
  }

private:
  static constexpr double reach = 0.5, distance_of_centers = 0.4, safety = 0.7;

  /// Weights fall with this power of the radius, so that small fits win: on a bowl whose density jumps by ten, that took
  /// the error of K beside the jump from 1e-2 to 3e-6.
  static constexpr double power_of_radius = 8;

  /// Calls f(k, weight, value, depth) for the patches k of a smooth part that have a weight at a point.
  template <class F>
  void for_each_weight(const Vector& p, Charts_3::Index chart, const F& f) const {
    balls_.for_each_around(p, [&](std::size_t k) {
      if (charts_of_fits_[k] != chart) return;
      const Patch_3& patch = fits_[k].patch;
      const double rest = 1 - (p - patch.center).squaredNorm() / (radii_[k] * radii_[k]);
      if (!(rest > 0)) return;
      const double g = patch.value(p), opening = 1 - g * g / (gates_[k] * gates_[k]);
      if (!(opening > 0)) return;
      const double root = rest * opening, cube = root * root * root;
      f(k, cube * cube * factors_[k], g, root);
    });
  }

  double gate(const Data_points_3& data, const Point_tree_3& tree, Data_points_3::Index center, double radius) const {
    const auto ball = connected_ball(data, center, 1.3 * radius);
    const std::unordered_set<Data_points_3::Index> connected(ball.begin(), ball.end());
    double least = std::numeric_limits<double>::infinity();
    tree.for_each_in_cube(data.points[center], radius, [&](Data_points_3::Index i) {
      const bool is_of_part = data.charts.of(i) == data.charts.of(center);
      if (is_of_part && !connected.contains(i)) least = std::min(least, (data.points[i] - data.points[center]).norm());
    });
    return safety * least;
  }

  std::vector<Curvature_fit_3> fits_;
  std::vector<Charts_3::Index> charts_of_fits_;
  std::vector<double> radii_, gates_, factors_;
  Ball_tree_3 balls_;
};

} // namespace equiaffine::internal

#endif
