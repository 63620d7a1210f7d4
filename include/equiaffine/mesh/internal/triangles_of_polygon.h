// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_TRIANGLES_OF_POLYGON_H
#define EQUIAFFINE_MESH_INTERNAL_TRIANGLES_OF_POLYGON_H

#include <equiaffine/base/Progress_observer.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// Triangulates a polygon in space, projected along its vector area.
class Planar_polygon {
public:
  using Triangle = std::array<std::size_t, 3>; ///< indices of corners

  explicit Planar_polygon(const std::vector<Eigen::Vector3d>& corners) {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 2; i < corners.size(); ++i)
      normal += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
    const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.normalized().cross(u);
    for (const Eigen::Vector3d& p : corners) corners_.emplace_back(u.dot(p - corners[0]), v.dot(p - corners[0]));
    rounding_ = 1e-12 * normal.norm();
  }

  std::vector<Triangle> triangles() const {
    constexpr std::size_t most_corners = 1000;
    std::vector<std::size_t> corners(corners_.size());
    std::iota(corners.begin(), corners.end(), std::size_t(0));
    const std::vector<Triangle> fan = fan_of(corners);
    const auto is_turned = [this](const Triangle& t) { return turn(t[0], t[1], t[2]) < -rounding_; };
    if (corners.size() > most_corners || std::none_of(fan.begin(), fan.end(), is_turned)) return fan;
    std::vector<Triangle> result;
    std::size_t start = 0;
    while (corners.size() > 3) {
      Progress_observer::step();
      const auto ear = find_ear(corners, start);
      if (!ear) return fan;
      result.push_back(triangle_at(corners, *ear));
      corners.erase(corners.begin() + std::ptrdiff_t(*ear));
      start = *ear;
    }
    result.push_back({corners[0], corners[1], corners[2]});
    return result;
  }

private:
  static std::vector<Triangle> fan_of(const std::vector<std::size_t>& corners) {
    std::vector<Triangle> result;
    for (std::size_t k = 2; k < corners.size(); ++k) result.push_back({corners[0], corners[k - 1], corners[k]});
    return result;
  }

  /// Twice the signed area of a triangle, positive if counterclockwise.
  double turn(std::size_t a, std::size_t b, std::size_t c) const {
    const Eigen::Vector2d x = corners_[b] - corners_[a], y = corners_[c] - corners_[a];
    return x[0] * y[1] - x[1] * y[0];
  }

  static Triangle triangle_at(const std::vector<std::size_t>& corners, std::size_t i) {
    const std::size_t n = corners.size();
    return {corners[(i + n - 1) % n], corners[i % n], corners[(i + 1) % n]};
  }

  /// Returns the first ear from position `start` on; one of zero area only if there is no other.
  std::optional<std::size_t> find_ear(const std::vector<std::size_t>& corners, std::size_t start) const {
    std::optional<std::size_t> flat;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::size_t i = (start + k) % corners.size();
      const Triangle t = triangle_at(corners, i);
      const double area = turn(t[0], t[1], t[2]);
      if (area > rounding_ && is_empty(corners, t)) return i;
      if (!flat && std::abs(area) <= rounding_) flat = i;
    }
    return flat;
  }

  /// Whether a triangle contains no other corner. Corners at the same place as its own belong to a slit and are
  /// ignored.
  bool is_empty(const std::vector<std::size_t>& corners, const Triangle& t) const {
    return std::none_of(corners.begin(), corners.end(), [&](std::size_t p) {
      const bool is_own = std::any_of(t.begin(), t.end(), [&](std::size_t q) { return corners_[p] == corners_[q]; });
      return !is_own && turn(t[0], t[1], p) >= 0 && turn(t[1], t[2], p) >= 0 && turn(t[2], t[0], p) >= 0;
    });
  }

  std::vector<Eigen::Vector2d> corners_;
  double rounding_; ///< of the double area
};

} // namespace equiaffine::internal

namespace equiaffine {

/// Appends the triangles of a polygon given by indices of points: the fan around its first corner if that flips no
/// triangle, as for convex polygons, otherwise by clipping ears (G. H. Meisters, Polygons have ears, 1975). For
/// self-intersecting polygons and those with more than 1000 corners it is the fan.
///
/// Takes linear time for a fan, and at most cubic time for ears.
/// \pre the indices are below the number of points
template <class Points>
void add_triangles_of_polygon(const Points& points, const std::vector<std::uint32_t>& polygon,
                              std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (polygon.size() < 4) {
    if (polygon.size() == 3) triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  std::vector<Eigen::Vector3d> corners;
  for (const std::uint32_t i : polygon) corners.emplace_back(points[i].x(), points[i].y(), points[i].z());
  for (const auto& [a, b, c] : internal::Planar_polygon(corners).triangles())
    triangles.push_back({polygon[a], polygon[b], polygon[c]});
}

} // namespace equiaffine

#endif
