// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_FEATURE_ENDS_3_H
#define EQUIAFFINE_SRC_DELAUNAY_FEATURE_ENDS_3_H

#include "delaunay/Feature_curve_3.h"
#include <equiaffine/surface/Clip_domain_3.h>

#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Joins the ends of features on a surface with the curves in which the surface meets the border of the clip domain.
class Feature_ends_3 {
  using Kernel = Any_function_3::Kernel;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;

public:
  /// `size` bounds the size of facets.
  Feature_ends_3(const Clip_domain_3& domain, double size) : domain_(domain), size_(size) {}

  /// Prolongs an open curve at those ends from which it reaches the border within the size of a facet.
  void extend(Feature_curve_3& curve) {
    auto& points = curve.polyline.points;
    if (curve.polyline.is_closed || points.size() < 2) return;
    for (int n = 0; n < 2; ++n) {
      std::reverse(points.begin(), points.end());
      extend_last(curve);
    }
  }

  bool is_on_border(const Point_3& p) const { return std::find(ends_.begin(), ends_.end(), p) != ends_.end(); }

  /// Cuts a curve on the border at the ends of the curves that `extend` brought there.
  std::vector<Polyline_3<Kernel>> split(Polyline_3<Kernel> curve) const {
    auto& points = curve.points;
    const std::vector<Point_3> cuts = insert_ends(curve);
    const auto is_cut = [&](const Point_3& p) { return std::find(cuts.begin(), cuts.end(), p) != cuts.end(); };
    if (cuts.empty()) return {std::move(curve)};
    if (curve.is_closed) {
      std::rotate(points.begin(), std::find_if(points.begin(), points.end(), is_cut), points.end());
      points.push_back(points.front());
    }
    std::vector<Polyline_3<Kernel>> pieces;
    for (std::size_t first = 0, n = 1; n < points.size(); ++n) {
      if (!is_cut(points[n]) && n + 1 < points.size()) continue;
      pieces.push_back(
          {std::vector<Point_3>(points.begin() + std::ptrdiff_t(first), points.begin() + std::ptrdiff_t(n) + 1)});
      first = n;
    }
    return pieces;
  }

private:
  void extend_last(Feature_curve_3& curve) {
    auto& points = curve.polyline.points;
    while (points.size() > 2 && !domain_.contains(points.back())) points.pop_back();
    const auto end = end_on_border(curve, points[points.size() - 2], points.back());
    if (!end) return;
    if (points.size() > 2 && CGAL::squared_distance(*end, points.back()) < size_ * size_ / 16) points.pop_back();
    points.push_back(*end);
    ends_.push_back(*end);
  }

  /// Inserts those ends into a curve that it passes through, nearer than chords are to the curve, and returns them.
  std::vector<Point_3> insert_ends(Polyline_3<Kernel>& curve) const {
    std::vector<Point_3> inserted;
    for (const Point_3& end : ends_) {
      const std::size_t n = nearest_segment(curve, end);
      if (CGAL::squared_distance(end, segment(curve, n)) > size_ * size_ / 256) continue;
      curve.points.insert(curve.points.begin() + std::ptrdiff_t(n) + 1, end);
      inserted.push_back(end);
    }
    return inserted;
  }

  static Kernel::Segment_3 segment(const Polyline_3<Kernel>& curve, std::size_t n) {
    return {curve.points[n], curve.points[(n + 1) % curve.points.size()]};
  }

  static std::size_t nearest_segment(const Polyline_3<Kernel>& curve, const Point_3& p) {
    const std::size_t segments = curve.points.size() - (curve.is_closed ? 0 : 1);
    std::size_t nearest = 0;
    for (std::size_t n = 1; n < segments; ++n)
      if (CGAL::squared_distance(p, segment(curve, n)) < CGAL::squared_distance(p, segment(curve, nearest)))
        nearest = n;
    return nearest;
  }

  /// A side of the box; a ball has one side only, which any value stands for.
  struct Side {
    int axis;
    bool is_upper;
  };

  /// The side beyond which p is furthest.
  Side side_beyond(const Point_3& p) const {
    const CGAL::Bbox_3& box = domain_.bbox();
    Side side{0, false};
    double largest = -std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
      for (const bool is_upper : {false, true}) {
        const double excess = is_upper ? p[axis] - box.max(axis) : box.min(axis) - p[axis];
        if (!(excess > largest)) continue;
        largest = excess;
        side = {axis, is_upper};
      }
    return side;
  }

  /// The distance of p from a side, positive inside.
  double depth(const Point_3& p, const Side& side) const {
    const CGAL::Bbox_3& box = domain_.bbox();
    if (!domain_.is_ball())
      return side.is_upper ? box.max(side.axis) - p[side.axis] : p[side.axis] - box.min(side.axis);
    const auto& c = domain_.center();
    return domain_.radius() - std::sqrt(CGAL::squared_distance(p, Point_3(c[0], c[1], c[2])));
  }

  /// Returns the point where the curve, which comes from `before` to its last point p, leaves the domain, or nothing if
  /// it does not leave it within the size of a facet.
  std::optional<Point_3> end_on_border(const Feature_curve_3& curve, const Point_3& before, const Point_3& p) const {
    const Vector_3 direction = p - before;
    const Point_3 guess = p + size_ / std::sqrt(direction.squared_length()) * direction;
    const auto beyond = curve.project(guess);
    if (!beyond || domain_.contains(*beyond) || CGAL::squared_distance(*beyond, guess) > size_ * size_ / 4) return {};
    return intersect_side(curve, p, *beyond);
  }

  /// Returns the point where the curve between a point inside and one outside of the domain meets the border. It is
  /// found by the Illinois variant of regula falsi.
  std::optional<Point_3> intersect_side(const Feature_curve_3& curve, Point_3 a, Point_3 b) const {
    constexpr int maximal_iterations = 60;
    const Side side = side_beyond(b);
    double depth_a = depth(a, side), depth_b = depth(b, side);
    for (int n = 0; n < maximal_iterations; ++n) {
      const auto m = curve.project(a + depth_a / (depth_a - depth_b) * (b - a));
      if (!m) return {};
      const double depth_m = depth(*m, side);
      if (std::abs(depth_m) <= 4 * std::numeric_limits<double>::epsilon() * domain_.diagonal())
        return on_side(*m, side);
      if (depth_m > 0) {
        a = *m;
        depth_a = depth_m;
        depth_b /= 2;
      } else {
        b = *m;
        depth_b = depth_m;
        depth_a /= 2;
      }
    }
    return {};
  }

  /// Returns p, moved into a side of the box; for a ball it returns p itself.
  Point_3 on_side(const Point_3& p, const Side& side) const {
    if (domain_.is_ball()) return p;
    std::array<double, 3> x = {p.x(), p.y(), p.z()};
    const CGAL::Bbox_3& box = domain_.bbox();
    x[std::size_t(side.axis)] = side.is_upper ? box.max(side.axis) : box.min(side.axis);
    return Point_3(x[0], x[1], x[2]);
  }

  const Clip_domain_3& domain_;
  const double size_;
  std::vector<Point_3> ends_; // ends on the border of the curves that were extended
};

} // namespace equiaffine::internal

#endif
