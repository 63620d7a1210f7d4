// SPDX-License-Identifier: GPL-3.0-or-later
// A closed box or ball that clips a surface.
#ifndef EQUIAFFINE_SURFACE_CLIP_DOMAIN_3_H
#define EQUIAFFINE_SURFACE_CLIP_DOMAIN_3_H

#include <equiaffine/base/Input_error.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace equiaffine::internal {

/// The default maximum facet radius in a box.
inline double default_facet_radius(const CGAL::Bbox_3& box) {
  return std::hypot(box.x_span(), box.y_span(), box.z_span()) / 50;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// A closed box or ball that clips a surface.
class Clip_domain_3 {
public:
  /// \throw std::invalid_argument unless the box has an interior and finite sides
  explicit Clip_domain_3(const CGAL::Bbox_3& box) : box_(box) { check(); }

  /// \throw std::invalid_argument unless the radius is positive and all coordinates are finite
  Clip_domain_3(const std::array<double, 3>& center, double radius)
      : box_(center[0] - radius, center[1] - radius, center[2] - radius, center[0] + radius, center[1] + radius,
             center[2] + radius),
        center_(center), radius_(radius) {
    check();
  }

  /// The ball around a point of CGAL. \throw std::invalid_argument as above
  template <class Point_3>
  Clip_domain_3(const Point_3& center, double radius) requires requires {
    CGAL::to_double(center.x());
  } : Clip_domain_3(std::array<double, 3>{CGAL::to_double(center.x()), CGAL::to_double(center.y()),
                                          CGAL::to_double(center.z())},
                    radius) {
  }

  /// The ball of a sphere of CGAL. \throw std::invalid_argument as above
  template <class Sphere_3>
  explicit Clip_domain_3(const Sphere_3& sphere) requires requires {
    CGAL::to_double(sphere.squared_radius());
  } : Clip_domain_3(sphere.center(), std::sqrt(CGAL::to_double(sphere.squared_radius()))) {
  }

  /// The largest ball around the center of a box that fits into it.
  static Clip_domain_3 ball_in(const CGAL::Bbox_3& box) {
    double radius = (box.max(0) - box.min(0)) / 2;
    std::array<double, 3> center;
    for (int a = 0; a < 3; ++a) {
      radius = std::min(radius, (box.max(a) - box.min(a)) / 2);
      center[std::size_t(a)] = (box.max(a) + box.min(a)) / 2;
    }
    return Clip_domain_3(center, radius);
  }

  bool is_ball() const { return radius_ > 0; }                    ///< whether it is a ball
  const std::array<double, 3>& center() const { return center_; } ///< center of the ball
  double radius() const { return radius_; }                       ///< radius of the ball; 0 for a box
  const CGAL::Bbox_3& bbox() const { return box_; }               ///< the box, or the bounding box of the ball
  /// The diagonal of bbox().
  double diagonal() const { return std::hypot(box_.x_span(), box_.y_span(), box_.z_span()); }

  /// Whether a point lies in the domain or on its border.
  template <class Point_3>
  bool contains(const Point_3& p) const {
    double squared_distance = 0;
    for (int a = 0; a < 3; ++a) {
      if (!(p[a] >= box_.min(a) && p[a] <= box_.max(a))) return false;
      squared_distance += (p[a] - center_[std::size_t(a)]) * (p[a] - center_[std::size_t(a)]);
    }
    return !is_ball() || squared_distance <= radius_ * radius_;
  }

  /// Whether a box is disjoint from the domain.
  bool excludes(const CGAL::Bbox_3& box) const {
    double squared_distance = 0;
    for (int a = 0; a < 3; ++a) {
      if (box.max(a) < box_.min(a) || box.min(a) > box_.max(a)) return true;
      const double c = center_[std::size_t(a)], d = std::max({box.min(a) - c, c - box.max(a), 0.0});
      squared_distance += d * d;
    }
    return is_ball() && squared_distance > radius_ * radius_;
  }

  /// Returns the first and last t in [first, last] for which p + t d lies in the domain.
  template <class Point_3, class Vector_3>
  std::optional<std::pair<double, double>> clip(const Point_3& p, const Vector_3& d, double first, double last) const {
    for (int a = 0; a < 3; ++a) {
      if (d[a] == 0) {
        if (p[a] < box_.min(a) || p[a] > box_.max(a)) return std::nullopt;
        continue;
      }
      const double s = (box_.min(a) - p[a]) / d[a], t = (box_.max(a) - p[a]) / d[a];
      first = std::max(first, std::min(s, t));
      last = std::min(last, std::max(s, t));
    }
    if (is_ball()) {
      const auto in_ball = parameters_in_ball(p, d);
      if (!in_ball) return std::nullopt;
      first = std::max(first, in_ball->first);
      last = std::min(last, in_ball->second);
    }
    if (!(first < last)) return std::nullopt;
    return std::pair(first, last);
  }

private:
  /// The first and last t for which p + t d lies in the ball.
  template <class Point_3, class Vector_3>
  std::optional<std::pair<double, double>> parameters_in_ball(const Point_3& p, const Vector_3& d) const {
    double dd = 0, qd = 0, qq = 0; // products of d and q = p - center
    for (int a = 0; a < 3; ++a) {
      const double q = p[a] - center_[std::size_t(a)];
      dd += d[a] * d[a];
      qd += q * d[a];
      qq += q * q;
    }
    const double discriminant = qd * qd - dd * (qq - radius_ * radius_);
    if (!(discriminant > 0)) return std::nullopt;
    return std::pair((-qd - std::sqrt(discriminant)) / dd, (-qd + std::sqrt(discriminant)) / dd);
  }

  void check() const {
    check_argument(
        box_.x_span() > 0 && box_.y_span() > 0 && box_.z_span() > 0,
        "a clip domain has no interior: choose a box whose upper bounds are greater than its lower bounds, or a "
        "positive radius");
    check_argument(std::isfinite(diagonal()), "a clip domain is not bounded: choose finite coordinates");
  }

  CGAL::Bbox_3 box_;
  std::array<double, 3> center_{};
  double radius_ = 0;
};

} // namespace equiaffine

#endif
