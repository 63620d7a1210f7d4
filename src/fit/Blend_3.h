// SPDX-License-Identifier: GPL-3.0-or-later
// The function of a fit: a blend of polynomials fitted to parts of the data.
#ifndef EQUIAFFINE_SRC_FIT_BLEND_3_H
#define EQUIAFFINE_SRC_FIT_BLEND_3_H

#include "fit/Band_3.h"
#include "fit/Curvature_fit_3.h"
#include "fit/Data_points_3.h"
#include "fit/Local_fit_3.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/fit/internal/Charts_3.h>
#include <equiaffine/number/Jet_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The mean of the patches around a point with weights (1 - |p - c|^2 / R^2)^6 / R^8, where c is the center of a
/// patch and R a fraction of its radius. Because of the factor 1 / R^8, small patches, which are more accurate,
/// dominate where they overlap with those of sparser data. Derivatives are means with the same weights, as if these
/// were constant: the diffuse derivatives of Nayroles, Touzot and Villon (1992). The derivatives of the weights
/// would only add the disagreement of the patches divided by powers of R. Each smooth part of the surface has its
/// own patches.
///
/// Another sheet of a part may lie within R, but its patches must not influence this one. Therefore the weight of a
/// patch is multiplied by (1 - (g / b)^2)^6, where g is its value and b is a fraction of the distance from its
/// center to the nearest point that is not connected with it.
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

  /// The smallest radius of the fits blended at a point; infinity if there are none.
  double least_radius(const Vector& p, Charts_3::Index chart) const {
    double least = std::numeric_limits<double>::infinity();
    for_each_weight(p, chart,
                    [&](std::size_t k, double, double, double) { least = std::min(least, fits_[k].patch.radius); });
    return least;
  }

  /// A mean, and the depth of the point in the patches: 1 at a center, 0 where patches end.
  template <class T>
  struct Mean {
    T value;
    double depth;
  };

  /// The mean value; NaN without patches.
  Mean<double> value(const Vector& p, Charts_3::Index chart) const {
    double sum = 0, weights = 0, depth = 0;
    for_each_weight(p, chart, [&](std::size_t, double weight, double g, double root) {
      sum += weight * g;
      weights += weight;
      depth = std::max(depth, root);
    });
    return {sum / weights, depth};
  }

  /// The mean expansion; NaN without patches.
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

  /// The accuracy of an expansion at a point: geometric means of the errors of the fits blended there, because these
  /// differ by orders of magnitude where K_e is about 0 for some fits. Where the curvatures of the expansion are
  /// larger than those of the fits, the relative errors are kept.
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
      if (number < std::numeric_limits<double>::min()) number = 0; // the exponential of minus infinity is not exactly 0
    const Number_errors factor = (mean.segment<n>(3 * n) / Fitted_numbers(jet).sizes()).max(1);
    return {mean.segment<n>(0) * factor, mean.segment<n>(n) * factor, mean.segment<n>(2 * n) * factor, least,
            mean[4 * n]};
  }

private:
  static constexpr double reach = 0.5, distance_of_centers = 0.4, safety = 0.7;

  /// Weights decrease with this power of the radius, so small fits dominate: on a bowl whose density jumps by ten,
  /// this reduced the error of K near the jump from 1e-2 to 3e-6.
  static constexpr double power_of_radius = 8;

  /// Calls f(k, weight, value, depth) for the patches k of a smooth part with a positive weight at a point.
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

/// One function from many patches, defined only near the part of its zero set that is close to the data: in a band,
/// with a margin as requested. Above the core of the band the data do not determine the polynomials. Where these
/// differ too much from the height above the surface, they are wrong, and the value changes continuously to that
/// height, as do first derivatives. Each smooth part between creases has its own function. Where parts meet, their
/// values are combined like those of half-spaces of a solid, see Charts_3.
class Blend_3 {
public:
  using Vector = Eigen::Vector3d;

  Blend_3(bool in_threads, const Data_points_3& data, const Fit_choices_3& choices)
      : charts_(data.charts), patches_(in_threads, data, choices),
        band_(feet(in_threads, data), data.charts.most_at_point) {}

  const Band_3& band() const { return band_; }

  double value(const Vector& p, const Band_margin& margin) const {
    if (!band_.contains(p, margin)) return std::numeric_limits<double>::quiet_NaN();
    const auto heights = band_.heights(p);
    return heights.size() == 1 ? value_of_part(p, heights.front()) : choice(p, heights).value;
  }

  /// The expansion at a point: to first order in the whole band, to a higher order where the value is that of
  /// polynomials alone. Fading does not change derivatives.
  template <int Order>
  Jet_3<double, Order> taylor(const Vector& p) const {
    using Jet = Jet_3<double, Order>;
    if (!band_.contains(p, {})) return Jet(std::numeric_limits<double>::quiet_NaN());
    const auto heights = band_.heights(p);
    if (heights.size() == 1) return taylor_of_part<Order>(p, heights.front());
    const Charts_3::Choice chosen = choice(p, heights);
    if (Order > 1 && chosen.fading != 0) return Jet(std::numeric_limits<double>::quiet_NaN());
    return taylor_of_part<Order>(p, heights[chosen.position]) + Jet(chosen.fading);
  }

  Fit_accuracy accuracy(const Vector& p, const Jet_3<double>& jet) const {
    const auto heights = band_.heights(p);
    const std::size_t position = heights.size() == 1 ? 0 : choice(p, heights).position;
    return patches_.accuracy(p, jet, heights[position].chart);
  }

private:
  /// Feet can be farther apart than the data. With a spacing of this fraction of their distance, the band extends by
  /// 0.75 of the distance across, so the middle of three equidistant feet, at 0.58, is in the band.
  static constexpr double part_of_gap = 0.6;

  /// From this multiple of the height of the core on, the value is the height alone; above the core, it is a
  /// mixture.
  static constexpr double top = 1.5;

  /// Parts less remote than this have their own value without fading, see Band_3::Height.
  static constexpr double near = 0.7;

  static bool is_above_core(const Band_3::Height& height) { return !(std::abs(height.value) < top * height.core); }

  static double smooth_step(double a, double b, double x) {
    const double t = std::clamp((x - a) / (b - a), 0., 1.);
    return t * t * (3 - 2 * t);
  }

  /// The weight of the height against the value of the polynomials: 0 in the core if both nearly agree; 1 above the
  /// core, where they differ by 0.8 spacings, and where patches end.
  static double part_of_height(const Patches_3::Mean<double>& mean, const Band_3::Height& height) {
    const auto& [value, depth] = mean;
    if (!std::isfinite(value) || is_above_core(height)) return 1;
    const double agreement = smooth_step(0.8, 0.4, std::abs(value - height.value) / height.spacing);
    return 1 - smooth_step(0, 0.1, depth) * agreement * smooth_step(top, 1, std::abs(height.value) / height.core);
  }

  /// The value of the function of one smooth part.
  double value_of_part(const Vector& p, const Band_3::Height& height) const {
    if (is_above_core(height)) return height.value;
    const auto mean = patches_.value(p, height.chart);
    const double part = part_of_height(mean, height);
    return part < 1 ? (1 - part) * mean.value + part * height.value : height.value;
  }

  /// The expansion of the function of one smooth part.
  template <int Order>
  Jet_3<double, Order> taylor_of_part(const Vector& p, const Band_3::Height& height) const {
    using Jet = Jet_3<double, Order>;
    const auto [jet, depth] =
        is_above_core(height) ? Patches_3::Mean<Jet>{Jet(height.value), 0} : patches_.taylor<Order>(p, height.chart);
    const double part = part_of_height({jet.value(), depth}, height);
    if (part == 0) return jet;
    if constexpr (Order > 1) {
      return Jet(std::numeric_limits<double>::quiet_NaN());
    } else {
      Jet plane(height.value);
      for (std::size_t axis = 0; axis < 3; ++axis) plane.coefficients()[1 + axis] = height.gradient[Eigen::Index(axis)];
      return part < 1 ? jet * (1 - part) + plane * part : plane;
    }
  }

  /// The part that determines the value of the function, and the term added by fading.
  Charts_3::Choice choice(const Vector& p, const std::vector<Band_3::Height>& heights) const {
    std::vector<Charts_3::Part_value> values;
    for (const Band_3::Height& height : heights) {
      const double fading = height.spacing * std::max(0., height.remoteness - near) / (1 - height.remoteness);
      values.push_back({height.chart, value_of_part(p, height), fading});
    }
    return charts_.combined(values);
  }

  /// The points of the zero set near the data.
  std::vector<Band_point_3> feet(bool in_threads, const Data_points_3& data) const {
    std::vector<std::optional<Band_point_3>> found(data.size());
    parallel_for(
        in_threads, 0, data.size(),
        [&](std::size_t i) {
          const Charts_3::Index chart = charts_.of(i);
          const auto foot = foot_on_surface(
              data.points[i], [&](const Vector& p) { return patches_.taylor<1>(p, chart).value; },
              [&](const Vector& p) { return patches_.least_radius(p, chart); }, 1e-3 * data.spacing[i], 8);
          if (!foot) return;
          const Vector unit = foot->gradient.normalized();
          const double core = sound_height(foot->point, unit, chart, Band_3::band_height * data.spacing[i]);
          found[i] = {foot->point, unit, data.spacing[i], core, {}, chart};
        },
        64);
    fill_holes(data, found);
    std::vector<std::optional<Border_gap_3>> gaps(data.size());
    parallel_for(
        in_threads, 0, data.size(), [&](std::size_t i) { gaps[i] = gap(data, found, Data_points_3::Index(i)); }, 256);
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

  /// A data point without a foot becomes its own foot, with the smallest core around it, if at least half of its
  /// neighbors have feet. It has no core if it belongs to a part between creases that has too few points for any
  /// foot. Other such points, for example off the surface or without a normal, are left out.
  static void fill_holes(const Data_points_3& data, std::vector<std::optional<Band_point_3>>& feet) {
    std::vector<char> has_feet(data.size()); // per part
    for (std::size_t i = 0; i < data.size(); ++i)
      if (feet[i]) has_feet[data.charts.of(i)] = 1;
    std::vector<std::pair<Data_points_3::Index, double>> filled; // with their cores
    for (Data_points_3::Index i = 0; i < data.size(); ++i) {
      if (feet[i] || data.normals[i].isZero() || data.spacing[i] == 0) continue;
      const auto around = data.neighbors_of(i);
      const auto known = std::count_if(around.begin(), around.end(), [&](auto j) { return feet[j].has_value(); });
      const bool is_of_few = data.charts.has_creases(data.charts.of(i)) && !has_feet[data.charts.of(i)];
      if (!is_of_few && (known == 0 || 2 * std::size_t(known) < around.size())) continue;
      double least = std::numeric_limits<double>::infinity();
      for (const auto j : around)
        if (feet[j]) least = std::min(least, feet[j]->core);
      filled.emplace_back(i, std::isinf(least) ? 0 : least);
    }
    for (const auto& [i, core] : filled)
      feet[i] = {data.points[i], data.normals[i], data.spacing[i], core, {}, data.charts.of(i)};
  }

  /// Returns the gap at the foot of a border point, if there is one: a sector with neither a neighbor nor another
  /// point nearby. At a crease the surface continues as another part.
  static std::optional<Border_gap_3> gap(const Data_points_3& data,
                                         const std::vector<std::optional<Band_point_3>>& feet, Data_points_3::Index i) {
    if (!feet[i] || data.charts.has_crease_at(i)) return {};
    if (!data.is_at_border.empty() && !data.is_at_border[i]) return {};
    std::vector<Vector> to_others;
    const auto add = [&](Data_points_3::Index j) {
      if (j != i && feet[j]) to_others.push_back(feet[j]->point - feet[i]->point);
    };
    for (const auto j : data.neighbors_of(i)) add(j);
    for (const auto j : connected_ball(data, i, Border_gap_3::radius * data.spacing[i])) add(j);
    return Border_gap_3::widest(feet[i]->normal, to_others);
  }

  /// The largest fraction of a height, halved up to three times, up to which values approximate the height on both
  /// sides. Data on flat parts determine little of a fit above them.
  double sound_height(const Vector& foot, const Vector& normal, Charts_3::Index chart, double height) const {
    const auto is_sound = [&](double h) { return patches_.value(foot + h * normal, chart).value / h > 0.5; };
    const double least = height / 8;
    double sound = least;
    for (double h = least; h <= height && is_sound(h) && is_sound(-h); h *= 2) sound = h;
    return sound;
  }

  Charts_3 charts_;
  Patches_3 patches_;
  Band_3 band_;
};

} // namespace equiaffine::internal

#endif
