// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_BAND_3_H
#define EQUIAFFINE_FIT_INTERNAL_BAND_3_H

#include <equiaffine/fit/internal/Border_gap_3.h>
#include <equiaffine/fit/internal/Normalization_3.h>
#include <equiaffine/fit/internal/Point_tree_3.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A point of the surface with its normal, the distance of the data around it, the height of the core there, and where
/// the surface does not go on, if the point is on its border.
struct Band_point_3 {
  Eigen::Vector3d point, normal;
  double spacing, core;
  std::optional<Border_gap_3> gap;
};

/// The part of space near points of a surface: within 2 spacings of the nearest one along its normal, or within a margin
/// that may be larger, within 1.25 spacings across, and no more than a quarter of a spacing beyond the border, since
/// polynomials that go on there know nothing. The core is a lower part of it.
class Band_3 {
public:
  using Vector = Eigen::Vector3d;

  struct Place {
    bool is_in_core;
    double height; ///< over the nearest point of the surface, along its normal; NaN beyond the margin
  };

  /// The margin holds points up to a height, and lets them be farther across the higher they are, as above a crease.
  struct Margin {
    double height = 0, slope = 0;
  };

  Band_3() = default;
  explicit Band_3(std::vector<Band_point_3> points) : points_(std::move(points)) {
    std::vector<Vector> places;
    std::vector<double> reaches;
    for (const auto& p : points_) {
      places.push_back(p.point);
      reaches.push_back(std::hypot(band_height, border) * p.spacing);
    }
    tree_ = Point_tree_3(places);
    balls_ = Ball_tree_3(places, reaches);
  }

  Place place(const Vector& p, const Margin& margin) const {
    const Place beyond = {false, std::numeric_limits<double>::quiet_NaN()};
    const auto nearest = tree_.nearest(p, 1);
    if (nearest.empty()) return beyond;
    const auto& [point, normal, spacing, core, gap] = points_[nearest.front()];
    const Vector difference = p - point;
    const double height = difference.dot(normal), size = std::abs(height);
    const Vector tangential = difference - height * normal;
    const double excess = std::max(tangential.norm() - border * spacing,
                                   gap ? gap->depth(tangential) - overhang * spacing : -border * spacing);
    if (size > std::max(margin.height, band_height * spacing) || excess > margin.slope * size) return beyond;
    return {size <= core && excess <= 0, height};
  }

  /// Returns a point moved along the normal of the nearest point of the surface into the tangent plane there; the same
  /// point if the band has none.
  Vector on_tangent_plane(const Vector& p) const {
    const auto nearest = tree_.nearest(p, 1);
    if (nearest.empty()) return p;
    const Band_point_3& foot = points_[nearest.front()];
    return p - (p - foot.point).dot(foot.normal) * foot.normal;
  }

  /// The distance of the data around the nearest point of the surface. \pre The band has points.
  double spacing(const Vector& p) const { return points_[tree_.nearest(p, 1).front()].spacing; }

  /// Returns whether some point of a box, given by its corners, may be in the band.
  bool may_meet(const Vector& lower, const Vector& upper, const Margin& margin) const {
    const Vector half = Vector::Constant(std::hypot(1, margin.slope) * margin.height);
    return balls_.meets(lower - half, upper + half);
  }

  /// Returns the box of the core in the coordinates of the data.
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
  std::vector<Band_point_3> points_;
  Point_tree_3 tree_;
  Ball_tree_3 balls_;
};

} // namespace equiaffine::internal

#endif
