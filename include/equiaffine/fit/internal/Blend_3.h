// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_BLEND_3_H
#define EQUIAFFINE_FIT_INTERNAL_BLEND_3_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/fit/internal/Band_3.h>
#include <equiaffine/fit/internal/Patch_cover_3.h>
#include <equiaffine/fit/internal/Point_tree_3.h>
#include <equiaffine/number/Jet_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// One function from many patches: the mean of the patches around a point with weights (1 - |p - c|^2 / R^2)^6 / R^8,
/// where c is the center of a patch and R a part of its radius. The factor gives small patches, which know more, the say
/// where those of sparser data overlap with them. Derivatives are means with the same weights, as if these were
/// constant: the diffuse derivatives of Nayroles, Touzot and Villon (1992). Those of the weights would only add what
/// patches disagree on, divided by powers of R. The function is defined near its zero set beside the data only: in the
/// core of a band, and in a margin as large as it is asked for, where the value is the height over the surface.
///
/// Another sheet of the surface may lie within R. Since a patch of that sheet is not to have a say on this one, its
/// weight is multiplied by (1 - (g / b)^2)^6, where g is its value and b is a part of the distance from its center to
/// the nearest point that is not connected with it.
class Blend_3 {
public:
  using Vector = Eigen::Vector3d;

  template <class ConcurrencyTag>
  Blend_3(const Data_points_3& data, const Fit_choice_3& choices, ConcurrencyTag tag) {
    auto cover = patch_cover(data, choices, Fit_use::BLEND, reach * distance_of_centers, tag);
    std::vector<Data_points_3::Index> centers;
    for (std::size_t k = 0; k < cover.centers.size(); ++k) {
      if (!cover.fits[k]) continue;
      centers.push_back(cover.centers[k]);
      radii_.push_back(reach * cover.fits[k]->patch.radius);
      fits_.push_back(std::move(*cover.fits[k]));
    }
    const Point_tree_3 tree(data.points);
    for (const double radius : radii_) factors_.push_back(std::pow(radius, -power_of_radius));
    gates_.resize(fits_.size());
    parallel_for<ConcurrencyTag>(0, fits_.size(),
                                 [&](std::size_t k) { gates_[k] = gate(data, tree, centers[k], radii_[k]); });
    std::vector<Vector> places;
    for (const auto& fit : fits_) places.push_back(fit.patch.center);
    balls_ = Ball_tree_3(places, radii_);
    band_ = Band_3(feet(data, tag));
  }

  const Band_3& band() const { return band_; }

  double value(const Vector& p, const Band_3::Margin& margin) const {
    const auto [is_in_core, height] = band_.place(p, margin);
    return is_in_core ? blended_value(p) : height;
  }

  /// The expansion at a point of the core.
  template <int Order>
  Jet_3<double, Order> taylor(const Vector& p) const {
    return band_.place(p, {}).is_in_core ? blend<Order>(p)
                                         : Jet_3<double, Order>(std::numeric_limits<double>::quiet_NaN());
  }

  /// The accuracy of an expansion at a point: geometric means of the errors of the fits that are blended there, since
  /// these differ by orders of magnitude where K_e is about 0 for some of the fits. Where the curvatures of the expansion
  /// are larger than those of the fits, they are as uncertain relative to their own size.
  Fit_accuracy accuracy(const Vector& p, const Jet_3<double>& jet) const {
    constexpr Eigen::Index n = number_of_fitted_numbers;
    using Numbers = Eigen::Array<double, 4 * n + 1, 1>;
    Numbers sum = Numbers::Zero();
    double weights = 0, least = std::numeric_limits<double>::infinity();
    for_each_weight(p, [&](std::size_t k, double weight, double) {
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

  /// Feet may be farther apart than the data are. A spacing of this part of their distance makes a band that reaches
  /// 0.75 of it across: the middle of three feet, at 0.58 of it if they are equally far apart, is in the band.
  static constexpr double part_of_gap = 0.6;

  /// Calls f(k, weight, value) for the patches k that have a weight at a point.
  template <class F>
  void for_each_weight(const Vector& p, const F& f) const {
    balls_.for_each_around(p, [&](std::size_t k) {
      const Patch_3& patch = fits_[k].patch;
      const double rest = 1 - (p - patch.center).squaredNorm() / (radii_[k] * radii_[k]);
      if (!(rest > 0)) return;
      const double g = patch.value(p), opening = 1 - g * g / (gates_[k] * gates_[k]);
      if (!(opening > 0)) return;
      const double root = rest * opening, cube = root * root * root;
      f(k, cube * cube * factors_[k], g);
    });
  }

  /// The least radius of the fits that are blended at a point; infinity where there is none.
  double least_radius(const Vector& p) const {
    double least = std::numeric_limits<double>::infinity();
    for_each_weight(p, [&](std::size_t k, double, double) { least = std::min(least, fits_[k].patch.radius); });
    return least;
  }

  /// The value, as far as patches reach; not a number without patches.
  double blended_value(const Vector& p) const {
    double sum = 0, weights = 0;
    for_each_weight(p, [&](std::size_t, double weight, double g) {
      sum += weight * g;
      weights += weight;
    });
    return sum / weights;
  }

  /// The expansion, as far as patches reach.
  template <int Order>
  Jet_3<double, Order> blend(const Vector& p) const {
    using Jet = Jet_3<double, Order>;
    Jet sum(0.);
    double weights = 0;
    for_each_weight(p, [&](std::size_t k, double weight, double) {
      sum += fits_[k].patch.template taylor<Order>(p) * weight;
      weights += weight;
    });
    return sum * (1 / weights);
  }

  double gate(const Data_points_3& data, const Point_tree_3& tree, Data_points_3::Index center, double radius) const {
    const auto ball = connected_ball(data, center, 1.3 * radius);
    const std::unordered_set<Data_points_3::Index> connected(ball.begin(), ball.end());
    double least = std::numeric_limits<double>::infinity();
    tree.for_each_in_cube(data.points[center], radius, [&](Data_points_3::Index i) {
      if (!connected.contains(i)) least = std::min(least, (data.points[i] - data.points[center]).norm());
    });
    return safety * least;
  }

  /// The points of the zero set beside the data. A datum whose foot is not found makes no part of the surface.
  template <class ConcurrencyTag>
  std::vector<Band_point_3> feet(const Data_points_3& data, ConcurrencyTag) const {
    std::vector<std::optional<Band_point_3>> found(data.size());
    parallel_for<ConcurrencyTag>(
        0, data.size(),
        [&](std::size_t i) {
          Vector p = data.points[i];
          for (int step = 0; step < 8; ++step) {
            const auto jet = blend<1>(p);
            const Vector gradient(jet.coefficients()[1], jet.coefficients()[2], jet.coefficients()[3]);
            const Vector newton = jet.value() * gradient / gradient.squaredNorm();
            if (!(newton.norm() < least_radius(p))) return;
            p -= newton;
            if (newton.norm() > 1e-3 * data.spacing[i]) continue;
            const Vector unit = gradient.normalized();
            found[i] = {p, unit, data.spacing[i], sound_height(p, unit, Band_3::band_height * data.spacing[i]), {}};
            return;
          }
        },
        64);
    std::vector<std::optional<Border_gap_3>> gaps(data.size());
    parallel_for<ConcurrencyTag>(
        0, data.size(), [&](std::size_t i) { gaps[i] = gap(data, found, Data_points_3::Index(i)); }, 256);
    std::vector<Band_point_3> result;
    for (std::size_t i = 0; i < data.size(); ++i) {
      if (!found[i]) continue;
      found[i]->gap = gaps[i];
      result.push_back(*found[i]);
      for (const auto j : data.neighbors_of(Data_points_3::Index(i)))
        if (found[j])
          result.back().spacing =
              std::max(result.back().spacing, part_of_gap * (found[j]->point - found[i]->point).norm());
    }
    return result;
  }

  /// Returns the gap beside the foot of a point where the surface does not go on, if there is one: neither a neighbor nor
  /// another point nearby is there.
  static std::optional<Border_gap_3> gap(const Data_points_3& data,
                                         const std::vector<std::optional<Band_point_3>>& feet, Data_points_3::Index i) {
    if (!feet[i]) return {};
    std::vector<Vector> to_others;
    const auto add = [&](Data_points_3::Index j) {
      if (j != i && feet[j]) to_others.push_back(feet[j]->point - feet[i]->point);
    };
    for (const auto j : data.neighbors_of(i)) add(j);
    for (const auto j : connected_ball(data, i, Border_gap_3::radius * data.spacing[i])) add(j);
    return Border_gap_3::widest(feet[i]->normal, to_others);
  }

  /// The greatest part of a height, halved up to three times, up to which values are about the height on both sides. Fits
  /// to flat parts do not know much of what is above them.
  double sound_height(const Vector& foot, const Vector& normal, double height) const {
    const auto is_sound = [&](double h) { return blended_value(foot + h * normal) / h > 0.5; };
    const double least = height / 8;
    double sound = least;
    for (double h = least; h <= height && is_sound(h) && is_sound(-h); h *= 2) sound = h;
    return sound;
  }

  std::vector<Curvature_fit_3> fits_;
  std::vector<double> radii_, gates_, factors_;
  Ball_tree_3 balls_;
  Band_3 band_;
};

} // namespace equiaffine::internal

#endif
