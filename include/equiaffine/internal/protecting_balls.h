// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_PROTECTING_BALLS_H
#define EQUIAFFINE_INTERNAL_PROTECTING_BALLS_H

#include <equiaffine/Polyline_3.h>

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A vertex of the mesh on a feature, and a ball that no other vertex may enter.
template <class Kernel>
struct Protecting_ball_3 {
  typename Kernel::Point_3 center;
  int dimension; ///< of the feature: 1 on a curve, 0 for a corner
  double radius = 0;
};

/// Covers curves and corners with balls. In the regular triangulation of such balls the segments between neighbors on a
/// curve are edges (Cheng, Dey, Ramos: Delaunay refinement for piecewise smooth complexes, 2010), if the balls of
/// neighbors overlap and no others do; near a sharp corner the balls get too small for that.
template <class Kernel>
class Protecting_balls_3 {
  using Point_3 = typename Kernel::Point_3;
  using Ball = Protecting_ball_3<Kernel>;

public:
  /// Balls along a polyline of short segments, at distances of at most `size(p)`. `project(p)` is a point of the curve
  /// near a point of the polyline, `project_end(p)` near an end, or nothing.
  template <class Sizing, class Projection, class End_projection>
  void cover(const Polyline_3<Kernel>& curve, const Sizing& size, const Projection& project,
             const End_projection& project_end) {
    std::vector<Point_3> points = curve.points;
    if (curve.is_closed) points.push_back(points.front());
    std::vector<double> length = {0}; // along the polyline, in sizes
    for (std::size_t n = 1; n < points.size(); ++n)
      length.push_back(length.back() +
                       distance(points[n - 1], points[n]) / size(CGAL::midpoint(points[n - 1], points[n])));
    const auto pieces = std::max(3.0, std::ceil(length.back()));
    std::vector<std::size_t> chain;
    const auto append_end = [&](const Point_3& p) {
      if (const auto end = project_end(p)) chain.push_back(corner(*end));
    };
    if (!curve.is_closed) append_end(points.front());
    for (std::size_t k = curve.is_closed ? 0 : 1, n = 1; double(k) < pieces; ++k) {
      const double at = length.back() * double(k) / pieces;
      while (length[n] < at) ++n;
      const double t = (at - length[n - 1]) / (length[n] - length[n - 1]);
      if (const auto p = project(points[n - 1] + t * (points[n] - points[n - 1]))) chain.push_back(add(*p, 1));
    }
    if (!curve.is_closed) append_end(points.back());
    for (std::size_t n = 1; n < chain.size(); ++n) join(chain[n - 1], chain[n]);
    if (curve.is_closed && chain.size() > 2) join(chain.back(), chain.front());
  }

  std::vector<Ball> operator()() {
    for (std::size_t n = 0; n < balls_.size(); ++n) {
      double shortest = std::numeric_limits<double>::infinity(), longest = 0;
      for (const std::size_t m : neighbors_[n]) {
        const double d = distance(balls_[n].center, balls_[m].center);
        shortest = std::min(shortest, d);
        longest = std::max(longest, d);
      }
      if (!neighbors_[n].empty()) balls_[n].radius = std::min(overlap * longest, 0.9 * shortest);
    }
    separate();
    return std::move(balls_);
  }

private:
  static constexpr double overlap = 0.52; // radius / distance of neighbors

  static double distance(const Point_3& p, const Point_3& q) { return std::sqrt(CGAL::squared_distance(p, q)); }

  std::size_t add(const Point_3& p, int dimension) {
    balls_.push_back({p, dimension});
    neighbors_.emplace_back();
    return balls_.size() - 1;
  }

  std::size_t corner(const Point_3& p) {
    const auto known =
        std::find_if(corners_.begin(), corners_.end(), [&](std::size_t n) { return balls_[n].center == p; });
    if (known != corners_.end()) return *known;
    corners_.push_back(add(p, 0));
    return corners_.back();
  }

  void join(std::size_t a, std::size_t b) {
    neighbors_[a].push_back(b);
    neighbors_[b].push_back(a);
  }

  /// Reduces balls that overlap though they are no neighbors.
  void separate() {
    std::vector<std::size_t> order(balls_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return balls_[a].center.x() < balls_[b].center.x(); });
    double largest = 0;
    for (const Ball& ball : balls_) largest = std::max(largest, ball.radius);
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        Ball &a = balls_[order[i]], &b = balls_[order[j]];
        if (b.center.x() - a.center.x() > 2 * largest) break;
        const auto& neighbors = neighbors_[order[i]];
        if (std::find(neighbors.begin(), neighbors.end(), order[j]) != neighbors.end()) continue;
        const double scale = 0.98 * distance(a.center, b.center) / (a.radius + b.radius);
        if (scale >= 0.98) continue;
        a.radius *= scale;
        b.radius *= scale;
      }
  }

  std::vector<Ball> balls_;
  std::vector<std::vector<std::size_t>> neighbors_; // along curves, per ball
  std::vector<std::size_t> corners_;
};

} // namespace equiaffine::internal

#endif
