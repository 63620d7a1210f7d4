// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_BORDER_CURVE_TRACER_3_H
#define EQUIAFFINE_SRC_DELAUNAY_BORDER_CURVE_TRACER_3_H

#include "delaunay/Domain_border_3.h"
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/Polyline_3.h>
#include <equiaffine/surface/internal/curve_step.h>

#include <CGAL/Kernel/global_functions_3.h>
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

/// Follows a curve in which a surface meets the border of a clip domain, from a point of it by short steps along the
/// tangent. On a box a curve belongs to a face, normal to an axis, and ends on its edges; the curves of both faces at
/// an edge get the same end.
template <ImplicitFunctionTraits_3 Traits>
class Border_curve_tracer_3 {
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using Border = Domain_border_3<Kernel>;

public:
  /// Steps have at most the length `step`. A projection moves a point by at most `reach`.
  Border_curve_tracer_3(const Traits& traits, const Border& border, double step, double reach)
      : traits_(traits), border_(border), step_(step), reach_(reach) {}

  /// Returns the point of the curve near p, or nothing if there is none within reach.
  std::optional<Point_3> project(Point_3 p, int axis) const {
    constexpr int maximal_iterations = 20;
    constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
    const Point_3 start = p;
    for (int n = 0; n < maximal_iterations; ++n) {
      const Vector_3 step = step_to_curve<Vector_3>(first_order(traits_, p), border_.function(p, axis));
      p = p + step;
      if (!(CGAL::squared_distance(p, start) <= reach_ * reach_)) return std::nullopt; // also NaN
      if (step.squared_length() <= rounding * rounding * (p - CGAL::ORIGIN).squared_length())
        return border_.snap(p, axis);
    }
    return std::nullopt;
  }

  Vector_3 gradient(const Point_3& p) const { return gradient_of<Vector_3>(first_order(traits_, p)); }

  /// The unit tangent of the curve.
  Vector_3 tangent(const Point_3& p, int axis) const {
    const Vector_3 t = CGAL::cross_product(gradient_of<Vector_3>(border_.function(p, axis)), gradient(p));
    return t / std::sqrt(t.squared_length());
  }

  /// The whole curve through a point of it.
  Polyline_3<Kernel> trace(const Point_3& start, int axis) {
    auto [points, is_closed] = follow(start, axis, 1);
    if (is_closed) {
      points.push_back(start);
      return {std::move(points), true};
    }
    const auto backward = follow(start, axis, -1).points;
    std::reverse(points.begin(), points.end());
    points.push_back(start);
    points.insert(points.end(), backward.begin(), backward.end());
    return {std::move(points), false};
  }

private:
  struct Half_curve {
    std::vector<Point_3> points; // the start is left out
    bool leads_back;             // whether the end is the start
  };

  /// Goes from a point in one direction along the tangent to an end of the curve, or around it.
  Half_curve follow(const Point_3& start, int axis, double direction) {
    std::vector<Point_3> points;
    Point_3 p = start;
    Vector_3 t = direction * tangent(p, axis);
    double length = 0;
    for (double h = step_; h > step_ / 100 && t == t;) { // a tangent of NaN ends the curve
      const Point_3 guess = p + h * t;
      const auto q = project(guess, axis);
      if (!q) // f may have no value outside of the box
        for (const int b : border_.axes_beyond(guess, axis))
          if (const auto end = end_on_edge(p, guess, axis, b)) {
            points.push_back(*end);
            return {std::move(points), false};
          }
      const Vector_3 next = q ? direction * tangent(*q, axis) : t;
      if (!q || !is_good_step(guess, *q, t, next, h)) {
        h /= 2;
        continue;
      }
      if (const auto beyond = border_.axes_beyond(*q, axis); !beyond.empty()) {
        if (const auto end = end_on_edge(p, *q, axis, beyond.front())) points.push_back(*end);
        return {std::move(points), false};
      }
      if (length > 2 * step_ && CGAL::squared_distance(*q, start) < step_ * step_ / 2) return {std::move(points), true};
      length += h;
      points.push_back(*q);
      p = *q;
      t = next;
      h = std::min(2 * h, step_);
    }
    return {std::move(points), false};
  }

  /// Whether a step along tangent t ended near the curve and the tangent of the curve there is nearly t.
  static bool is_good_step(const Point_3& guess, const Point_3& q, const Vector_3& t, const Vector_3& next, double h) {
    constexpr double smallest_cosine = 0.95;
    return CGAL::squared_distance(q, guess) < h * h / 16 && next * t > smallest_cosine;
  }

  /// The end of the curve between p and q, which is outside of the box along axis b: Newton's method for f on the edge
  /// of the box. Curves that end at the same place get the same point.
  std::optional<Point_3> end_on_edge(const Point_3& p, const Point_3& q, int axis, int b) {
    constexpr int maximal_iterations = 20;
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    const double limit = q[b] > border_.box().max(b) ? border_.box().max(b) : border_.box().min(b);
    const int c = 3 - axis - b; // along the edge
    Point_3 end = p + (limit - p[b]) / (q[b] - p[b]) * (q - p);
    for (int n = 0; n < maximal_iterations; ++n) {
      const auto jet = first_order(traits_, end);
      const double step = -jet.value() / jet.coefficients()[std::size_t(1 + c)];
      end = border_.snap(end, axis);
      std::array<double, 3> x = {end.x(), end.y(), end.z()};
      Border::at(x, b) = limit;
      Border::at(x, c) += step;
      end = Point_3(x[0], x[1], x[2]);
      if (!(CGAL::squared_distance(end, p) <= 4 * step_ * step_)) return std::nullopt;
      if (n > 0 && std::abs(step) <= rounding * std::abs(Border::at(x, c))) break;
    }
    if (!border_.axes_beyond(end, axis).empty()) return std::nullopt; // the curve leaves the box elsewhere
    for (const Point_3& known : ends_)
      if (CGAL::squared_distance(known, end) < 1e-12 * step_ * step_) return known;
    ends_.push_back(end);
    return end;
  }

  const Traits& traits_;
  const Border& border_;
  const double step_, reach_;
  std::vector<Point_3> ends_; // on edges of the box
};

} // namespace equiaffine::internal

#endif
