// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_MAPPED_FUNCTION_3_H
#define EQUIAFFINE_SRC_REGISTRATION_MAPPED_FUNCTION_3_H

#include "registration/Affine_map_3.h"
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/internal/sign_change.h>
#include <equiaffine/surface/internal/jet_derivatives.h>

#include <CGAL/Bbox_3.h>
#include <Eigen/Core>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A function in other coordinates, on its box, which is a parallelepiped there.
class Mapped_function_3 {
public:
  /// `map` goes from the coordinates of the function to the other ones.
  Mapped_function_3(Any_function_3 function, const Affine_map_3& map)
      : function_(std::move(function)), map_(map), inverse_(map.inverse()), box_(function_.bbox()) {
    for (int a = 0; a < 3; ++a) {
      lower_[a] = box_.min(a);
      sides_[a] = box_.max(a) - box_.min(a);
    }
  }

  const Affine_map_3& map() const { return map_; }
  Eigen::Vector3d center() const { return map_(lower_ + sides_ / 2); }

  /// The radius of the ball around the center that holds the box.
  double radius() const {
    double result = 0;
    for (int corner = 0; corner < 8; ++corner)
      result = std::max(
          result,
          (map_(lower_ + sides_.cwiseProduct(Eigen::Vector3d(corner & 1, corner >> 1 & 1, corner >> 2 & 1))) - center())
              .norm());
    return result;
  }

  /// The value at parts, from 0 to 1, of the sides of the box.
  double value_in_box(const Eigen::Vector3d& parts) const {
    return function_.value(to_CGAL(lower_ + sides_.cwiseProduct(parts)));
  }

  std::vector<double> values(const std::vector<Eigen::Vector3d>& points) const {
    std::vector<Point_3> at;
    at.reserve(points.size());
    for (const Eigen::Vector3d& p : points) at.push_back(to_CGAL(inverse_(p)));
    std::vector<double> result(points.size());
    function_.values(at, result);
    return result;
  }

  /// The part of a line that is in the box: its first and its last parameter.
  std::pair<double, double> part_in_box(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d from = inverse_(origin) - lower_, along = inverse_.matrix * direction;
    double first = -std::numeric_limits<double>::infinity(), last = -first;
    for (int a = 0; a < 3; ++a) {
      const double s = -from[a] / along[a], t = (sides_[a] - from[a]) / along[a];
      first = std::max(first, std::min(s, t));
      last = std::min(last, std::max(s, t));
    }
    return {first, last};
  }

  /// The value, and the gradient in the coordinates of this function. They are NaN outside of the box. Where two parts
  /// of a maximum are the same, the expansion of it is not finite, and differences take its place.
  std::pair<double, Eigen::Vector3d> first_order(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d q = inverse_(p);
    if (!contains(q)) {
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      return {nan, Eigen::Vector3d::Constant(nan)};
    }
    const auto jet = function_.first_order(to_CGAL(q));
    Eigen::Vector3d gradient = eigen_gradient(jet);
    if (!gradient.allFinite()) gradient = differences(q);
    return {jet.value(), inverse_.matrix.transpose() * gradient};
  }

  Eigen::Vector3d gradient(const Eigen::Vector3d& p) const { return first_order(p).second; }

  /// A zero on a segment at whose ends the signs differ, or nothing where there is a pole or a jump.
  std::optional<Eigen::Vector3d> zero_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    const Point_3 p = to_CGAL(inverse_(a)), q = to_CGAL(inverse_(b));
    const double f = function_.value(p), g = function_.value(q);
    if (!is_sign_change(f, g)) return std::nullopt;
    const auto found = function_.intersect_segment(p, q, f, g);
    if (!found.has_converged) return std::nullopt;
    return map_(Eigen::Vector3d(found.point.x(), found.point.y(), found.point.z()));
  }

private:
  using Point_3 = Any_function_3::Point_3;

  Eigen::Vector3d differences(const Eigen::Vector3d& q) const {
    const double step = 1e-6 * sides_.maxCoeff();
    const auto value = [&](const Eigen::Vector3d& p) { return function_.value(to_CGAL(p)); };
    Eigen::Vector3d result;
    for (int a = 0; a < 3; ++a) {
      const Eigen::Vector3d shift = step * Eigen::Vector3d::Unit(a);
      result[a] = (value(q + shift) - value(q - shift)) / (2 * step);
    }
    return result;
  }

  static Point_3 to_CGAL(const Eigen::Vector3d& p) { return Point_3(p[0], p[1], p[2]); }

  bool contains(const Eigen::Vector3d& p) const {
    return (p.array() >= lower_.array()).all() && ((p - lower_).array() <= sides_.array()).all();
  }

  Any_function_3 function_;
  Affine_map_3 map_, inverse_;
  CGAL::Bbox_3 box_;
  Eigen::Vector3d lower_, sides_;
};

} // namespace equiaffine::internal

#endif
