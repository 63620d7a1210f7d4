// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_BORDER_GAP_3_H
#define EQUIAFFINE_SRC_FIT_BORDER_GAP_3_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The sector of the tangent plane at a point of the border of a surface where the surface does not go on:
/// counterclockwise about the normal from one direction to another, both unit vectors.
class Border_gap_3 {
public:
  using Vector = Eigen::Vector3d;

  /// A sector without other points nearer than `radius` spacings is a gap if it is wider than this. At a point of a random
  /// sample without border, some 44 points are so near, and a sector of a third of the plane is empty with the chance
  /// 44 (2/3)^43 = 1e-6. A round hole has gaps if its radius is larger than this one.
  static constexpr double radius = 3.5, least_angle = 2 * std::numbers::pi / 3;

  /// The widest sector without any of the vectors to other points, if it is a gap.
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

  /// The distance of a tangent vector in the sector from the sides of the sector; 0 elsewhere.
  double depth(const Vector& v) const {
    const auto is_left = [&](const Vector& from, const Vector& to) { return from.cross(to).dot(normal_) > 0; };
    const bool is_inside =
        is_convex_ ? is_left(first_, v) && is_left(v, last_) : !is_left(last_, v) || !is_left(v, first_);
    return is_inside ? std::min(distance(v, first_), distance(v, last_)) : 0;
  }

private:
  Border_gap_3(const Vector& normal, const Vector& first, const Vector& last, double width)
      : normal_(normal), first_(first), last_(last), is_convex_(width <= std::numbers::pi) {}

  /// The distance of a vector from a ray.
  static double distance(const Vector& v, const Vector& direction) {
    return (v - std::max(0., v.dot(direction)) * direction).norm();
  }

  Vector normal_, first_, last_;
  bool is_convex_;
};

} // namespace equiaffine::internal

#endif
