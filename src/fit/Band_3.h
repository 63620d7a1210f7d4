// SPDX-License-Identifier: GPL-3.0-or-later
// The band around the data where the function of a fit is defined.
#ifndef EQUIAFFINE_SRC_FIT_BAND_3_H
#define EQUIAFFINE_SRC_FIT_BAND_3_H

#include "fit/Data_points_3.h"
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/internal/Charts_3.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// An empty sector of the tangent plane at a border point of a surface: counterclockwise about the normal between
/// two unit vectors.
class Border_gap_3 {
public:
  using Vector = Eigen::Vector3d;

  /// A sector without other points within `radius` spacings is a gap if it is wider than this. Around a point of a
  /// random sample without border, about 44 points are that close, and the probability that a sector of a third of
  /// the plane is empty is 44 (2/3)^43 = 1e-6. A round hole has gaps if its radius is larger than this one.
  static constexpr double radius = 3.5, least_angle = 2 * std::numbers::pi / 3;

  /// Returns the widest sector that contains none of the vectors to other points, if it is a gap.
  static std::optional<Border_gap_3> widest(const Vector& normal, const std::vector<Vector>& to_others) {
    const Vector x = normal.unitOrthogonal(), y = normal.cross(x);
    std::vector<std::pair<double, Vector>> directions;
    for (const Vector& v : to_others) {
      const Vector tangential = v - v.dot(normal) * normal;
      if (tangential.norm() > 0)
        directions.emplace_back(std::atan2(tangential.dot(y), tangential.dot(x)), tangential.normalized());
    }
    std::sort(directions.begin(), directions.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::optional<Border_gap_3> gap;
    double widest = least_angle;
    for (std::size_t n = 0; n < directions.size(); ++n) {
      const bool is_last = n + 1 == directions.size();
      const auto& [angle, first] = directions[n];
      const auto& [next_angle, last] = directions[is_last ? 0 : n + 1];
      const double width = next_angle - angle + (is_last ? 2 * std::numbers::pi : 0);
      if (width > widest) gap = Border_gap_3(normal, first, last, width), widest = width;
    }
    return gap;
  }

  /// The distance of a tangent vector in the sector from the sides of the sector; 0 outside.
  double depth(const Vector& v) const {
    const auto is_left = [&](const Vector& from, const Vector& to) { return from.cross(to).dot(normal_) > 0; };
    const bool is_inside =
        is_convex_ ? is_left(first_, v) && is_left(v, last_) : !is_left(last_, v) || !is_left(v, first_);
    return is_inside ? std::min(distance(v, first_), distance(v, last_)) : 0;
  }

private:
  Border_gap_3(const Vector& normal, const Vector& first, const Vector& last, double width)
      : normal_(normal), first_(first), last_(last), is_convex_(width <= std::numbers::pi) {}

  static double distance(const Vector& v, const Vector& direction) {
    return (v - std::max(0., v.dot(direction)) * direction).norm();
  }

  Vector normal_, first_, last_;
  bool is_convex_;
};

/// A point of the surface with its normal, the spacing of the data around it, the height of the core, and the gap if
/// it is on the border.
struct Band_point_3 {
  Eigen::Vector3d point, normal;
  double spacing, core;
  std::optional<Border_gap_3> gap;
  Charts_3::Index chart; ///< smooth part of the surface
};

/// The region near points of a surface: within 2 spacings of the nearest point along its normal, or within a margin
/// that may be larger, within 1.25 spacings across, and at most a quarter of a spacing beyond the border, where
/// polynomials are only extrapolated. Away from borders, points within 1 spacing across of another nearby point
/// belong to the band, too, because the density may jump. The core is a lower part of the band.
class Band_3 {
public:
  using Vector = Eigen::Vector3d;

  /// The height above a smooth part of the surface, a blend of planes, and associated means.
  struct Height {
    Charts_3::Index chart;
    double value = 0;
    Vector gradient = Vector::Zero(); ///< mean normal
    double spacing = 0, core = 0;     ///< means
    double remoteness = 0;            ///< from 0 for the part of the nearest point to 1 for a part whose points have no
                                      ///< weight
  };

  /// At most `most_at_point` smooth parts of the surface meet at a point.
  explicit Band_3(std::vector<Band_point_3> points, std::size_t most_at_point = 1)
      : points_(std::move(points)), count_(std::clamp<std::size_t>(2 * most_at_point, 9, 64)) {
    std::vector<Vector> places;
    std::vector<double> reaches;
    for (const auto& p : points_) {
      places.push_back(p.point);
      reaches.push_back(std::hypot(band_height, border) * p.spacing);
    }
    tree_ = Point_tree_3(places);
    balls_ = Ball_tree_3(places, reaches);
  }

  /// Whether a point is in the band widened by the margin.
  bool contains(const Vector& p, const Band_margin& margin) const {
    const auto nearest = tree_.nearest(p, 1);
    if (nearest.empty()) return false;
    if (contains(p, points_[nearest.front()], border, margin)) return true;
    const auto feet = tree_.nearest(p, count_);
    return std::none_of(feet.begin(), feet.end(), [&](auto i) { return points_[i].gap.has_value(); }) &&
           std::any_of(feet.begin(), feet.end(), [&](auto i) { return contains(p, points_[i], 1, margin); });
  }

  /// Returns the heights above the smooth parts of the nearest points, that of the nearest point first. A height is
  /// the mean of the heights above the tangent planes at these points, with weights ((R - d) / (R d))^2, where R is
  /// the distance of the next nearest point. This makes the mean continuous (Renka, Multivariate interpolation of
  /// large sets of scattered data, 1988, with planes instead of quadratic functions).
  /// \pre the band has points.
  std::vector<Height> heights(const Vector& p) const {
    const std::vector<Foot> feet = nearest_feet(p);
    const double reach = feet.size() < count_ ? std::numeric_limits<double>::infinity() : feet.back().distance;
    const double nearest = feet.front().distance;
    std::vector<Height> result;
    for (const Charts_3::Index chart : charts_of(feet)) {
      Height& height = result.emplace_back(Height{chart});
      double sum = 0;
      for (const auto& [index, distance] : feet) {
        const auto& [point, normal, spacing, core, gap, own_chart] = points_[index];
        if (own_chart != chart) continue;
        if (sum == 0 && !std::isinf(reach) && reach > nearest)
          height.remoteness = std::min((distance - nearest) / (reach - nearest), 1 - 1e-9);
        const double least = 1e-6 * spacing, d = std::max(distance, least); // at a point its own plane dominates
        const double root = (std::isinf(reach) ? 1 : std::max(1e-9, (reach - d) / reach)) / d, weight = root * root;
        height.value += weight * (p - point).dot(normal);
        height.gradient += weight * normal;
        height.spacing += weight * spacing;
        height.core += weight * core;
        sum += weight;
      }
      height.value /= sum, height.gradient /= sum, height.spacing /= sum, height.core /= sum;
    }
    return result;
  }

  /// Returns a point moved along the normal of the nearest surface point into the tangent plane there; the same
  /// point if the band has no points.
  Vector on_tangent_plane(const Vector& p) const {
    const auto nearest = tree_.nearest(p, 1);
    if (nearest.empty()) return p;
    const Band_point_3& foot = points_[nearest.front()];
    return p - (p - foot.point).dot(foot.normal) * foot.normal;
  }

  /// The spacing of the data around the nearest point of the surface. \pre The band has points.
  double spacing(const Vector& p) const { return points_[tree_.nearest(p, 1).front()].spacing; }

  /// Returns whether the band may contain a point of a box, given by its corners.
  bool may_meet(const Vector& lower, const Vector& upper, const Band_margin& margin) const {
    const Vector half = Vector::Constant(std::hypot(1, margin.slope) * margin.height);
    return balls_.meets(lower - half, upper + half);
  }

  /// Returns the bounding box of the core in the coordinates of the data.
  CGAL::Bbox_3 box(const Normalization_3& normalization) const {
    CGAL::Bbox_3 box;
    const Eigen::Matrix3d inverse = normalization.matrix.inverse();
    const Vector reach_of_axes = inverse.rowwise().norm();
    for (const auto& p : points_) {
      const Vector center = normalization.origin + inverse * p.point;
      const Vector half = std::hypot(band_height, border) * p.spacing * reach_of_axes;
      const Vector lower = center - half, upper = center + half;
      box += CGAL::Bbox_3(lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]);
    }
    return box;
  }

  static constexpr double band_height = 2, border = 1.25, overhang = 0.25; ///< in spacings

private:
  /// Whether a point is near a foot: up to a distance across, in spacings, and not beyond the border.
  static bool contains(const Vector& p, const Band_point_3& foot, double across, const Band_margin& margin) {
    const Vector difference = p - foot.point;
    const double height = difference.dot(foot.normal), size = std::abs(height), spacing = foot.spacing;
    const Vector tangential = difference - height * foot.normal;
    const double excess = std::max(tangential.norm() - across * spacing,
                                   foot.gap ? foot.gap->depth(tangential) - overhang * spacing : -border * spacing);
    return size <= std::max(margin.height, band_height * spacing) && excess <= margin.slope * size;
  }

  struct Foot {
    Data_points_3::Index index;
    double distance;
  };

  /// The nearest points, sorted by distance.
  std::vector<Foot> nearest_feet(const Vector& p) const {
    std::vector<Foot> feet;
    for (const auto i : tree_.nearest(p, count_)) feet.push_back({i, (p - points_[i].point).norm()});
    std::sort(feet.begin(), feet.end(), [](const Foot& a, const Foot& b) {
      return a.distance != b.distance ? a.distance < b.distance : a.index < b.index;
    });
    return feet;
  }

  std::vector<Charts_3::Index> charts_of(const std::vector<Foot>& feet) const {
    std::vector<Charts_3::Index> charts;
    for (const Foot& foot : feet)
      if (std::find(charts.begin(), charts.end(), points_[foot.index].chart) == charts.end())
        charts.push_back(points_[foot.index].chart);
    return charts;
  }

  std::vector<Band_point_3> points_;
  std::size_t count_; ///< number of nearest points considered: 9, or more for corners of many parts
  Point_tree_3 tree_;
  Ball_tree_3 balls_;
};

} // namespace equiaffine::internal

#endif
