// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESHER_BORDER_CURVES_3_H
#define EQUIAFFINE_MESHER_BORDER_CURVES_3_H

#include <equiaffine/delaunay/Seed_grid_3.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/Polyline_3.h>
#include <equiaffine/surface/curve_step.h>
#include <equiaffine/surface/project_to_surface.h>
#include <equiaffine/surface/sign_change.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The curves in which a surface meets the border of a clip domain, as polylines of short segments with vertices on
/// both. Along an edge of a box a curve ends; the polylines on both sides of it have that end in common.
///
/// A curve that winds within less than `spacing`, and a closed one that small, may be missed.
template <ImplicitFunctionTraits_3 Traits>
class Border_curves_3 {
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using Grid = Seed_grid_3<Point_3, Vector_3>;
  using Seed = typename Grid::Seed;

  /// A face of the box, or of the cube whose central projection the sphere is; (u, v) in [0, 1]^2.
  struct Face {
    int axis;
    bool is_upper;
  };

public:
  struct Curve : Polyline_3<Kernel> {
    int axis = 0; // normal to its face of a box
  };

  Border_curves_3(const Traits& traits, const Clip_domain_3& domain, double spacing)
      : traits_(traits), domain_(domain), box_(domain.bbox()), pitch_(spacing / 2), step_(spacing / 8) {}

  std::vector<Curve> operator()() {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool is_upper : {false, true}) {
        if (!domain_.is_ball()) on_face_ = Grid(); // curves on other faces are others, however near
        search({axis, is_upper}, {0, 1}, {0, 1});
      }
    return std::move(curves_);
  }

  /// The point of the curve near p; nothing if there is none within a pitch.
  std::optional<Point_3> project(Point_3 p, int axis) const {
    constexpr int maximal_iterations = 20;
    const Point_3 start = p;
    for (int n = 0; n < maximal_iterations; ++n) {
      const Vector_3 step = step_to_curve<Vector_3>(first_order(traits_, p), border(p, axis));
      p = p + step;
      if (!(CGAL::squared_distance(p, start) <= pitch_ * pitch_)) return std::nullopt; // also NaN
      const double rounding = 8 * std::numeric_limits<double>::epsilon();
      if (step.squared_length() <= rounding * rounding * (p - CGAL::ORIGIN).squared_length()) return on_border(p, axis);
    }
    return std::nullopt;
  }

private:
  Point_3 point(const Face& face, double u, double v) const {
    const int b = (face.axis + 1) % 3, c = (face.axis + 2) % 3;
    std::array<double, 3> p;
    if (!domain_.is_ball()) {
      at(p, face.axis) = face.is_upper ? box_.max(face.axis) : box_.min(face.axis);
      at(p, b) = std::lerp(box_.min(b), box_.max(b), u);
      at(p, c) = std::lerp(box_.min(c), box_.max(c), v);
    } else {
      const auto slope = [](double t) { return std::tan(std::numbers::pi / 2 * (t - 0.5)); };
      const double x = slope(u), y = slope(v), scale = domain_.radius() / std::sqrt(1 + x * x + y * y);
      at(p, face.axis) = domain_.center()[std::size_t(face.axis)] + (face.is_upper ? scale : -scale);
      at(p, b) = domain_.center()[std::size_t(b)] + x * scale;
      at(p, c) = domain_.center()[std::size_t(c)] + y * scale;
    }
    return Point_3(p[0], p[1], p[2]);
  }

  /// Curves that cross the sides of small parts of a face.
  void search(const Face& face, const std::pair<double, double>& u, const std::pair<double, double>& v) {
    const std::array<Point_3, 4> p = {point(face, u.first, v.first), point(face, u.second, v.first),
                                      point(face, u.second, v.second), point(face, u.first, v.second)};
    CGAL::Bbox_3 box;
    for (const Point_3& corner : p) box += corner.bbox();
    const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
    if (is_empty(box, domain_.is_ball() ? diagonal / 2 : 0)) return;
    if (diagonal > pitch_) {
      const double s = (u.first + u.second) / 2, t = (v.first + v.second) / 2;
      for (const auto& part : {std::pair(u.first, s), std::pair(s, u.second)})
        for (const auto& other : {std::pair(v.first, t), std::pair(t, v.second)}) search(face, part, other);
      return;
    }
    std::array<double, 4> value;
    for (std::size_t n = 0; n < 4; ++n) value[n] = traits_.value(p[n]);
    for (std::size_t n = 0, m = 1; n < 4; ++n, m = (m + 1) % 4) {
      if (!is_sign_change(value[n], value[m])) continue;
      const auto root = intersect_segment(traits_, p[n], p[m], value[n], value[m]);
      if (!root.has_converged) continue;
      const auto start = project(root.point, face.axis);
      if (start && !is_traced(*start, face.axis)) trace(*start, face.axis);
    }
  }

  /// A curve that runs in an edge of the box lies in two faces.
  bool is_traced(const Point_3& p, int axis) {
    const Seed seed{p, gradient(p), pitch_};
    if (on_face_.is_crowded(seed)) return true;
    if (domain_.is_ball()) return false;
    const Vector_3 t = tangent(p, axis);
    for (int b = 0; b < 3; ++b) {
      const double distance = std::min(std::abs(p[b] - box_.min(b)), std::abs(p[b] - box_.max(b)));
      if (b != axis && distance < 1e-6 * step_ && std::abs(t[b]) < 1e-6) return traced_.is_crowded(seed);
    }
    return false;
  }

  bool is_empty(const CGAL::Bbox_3& b, double margin) const {
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>)
      return !traits_
                  .bounds(CGAL::Bbox_3(b.xmin() - margin, b.ymin() - margin, b.zmin() - margin, b.xmax() + margin,
                                       b.ymax() + margin, b.zmax() + margin))
                  .contains(0);
    else return false;
  }

  void trace(const Point_3& start, int axis) {
    Curve curve;
    curve.axis = axis;
    curve.is_closed = follow(start, axis, 1, curve.points);
    if (!curve.is_closed) {
      std::vector<Point_3> backward;
      follow(start, axis, -1, backward);
      std::reverse(curve.points.begin(), curve.points.end());
      curve.points.push_back(start);
      curve.points.insert(curve.points.end(), backward.begin(), backward.end());
    } else {
      curve.points.push_back(start);
    }
    for (const Point_3& p : curve.points) {
      const Seed seed{p, gradient(p), pitch_};
      traced_.insert(seed);
      on_face_.insert(seed);
    }
    if (!curve.is_closed) drop_neighbors_of_ends(curve.points);
    if (curve.is_closed || !is_short(curve.points.front(), curve.points.back())) curves_.push_back(std::move(curve));
  }

  bool is_short(const Point_3& p, const Point_3& q) const { return CGAL::squared_distance(p, q) < step_ * step_ / 100; }

  /// A step may end right before an edge of the box, or the curve may have been found there.
  void drop_neighbors_of_ends(std::vector<Point_3>& p) const {
    while (p.size() > 2 && is_short(p[0], p[1])) p.erase(p.begin() + 1);
    while (p.size() > 2 && is_short(p[p.size() - 1], p[p.size() - 2])) p.erase(p.end() - 2);
  }

  /// Appends the points that follow p in one direction, by steps along the tangent; whether they lead back to p.
  bool follow(const Point_3& start, int axis, double direction, std::vector<Point_3>& points) {
    constexpr double smallest_cosine = 0.95;
    Point_3 p = start;
    Vector_3 t = direction * tangent(p, axis);
    double length = 0;
    for (double h = step_; h > step_ / 100 && t == t;) {
      const Point_3 guess = p + h * t;
      const auto q = project(guess, axis);
      if (!q && !domain_.contains(guess) && !domain_.is_ball()) { // outside, f may have no value
        for (int b = 0; b < 3; ++b) {
          if (b == axis || (guess[b] >= box_.min(b) && guess[b] <= box_.max(b))) continue;
          if (const auto end = end_on_edge(p, guess, axis, b)) {
            points.push_back(*end);
            return false;
          }
        }
      }
      const Vector_3 next = q ? direction * tangent(*q, axis) : t;
      if (!q || !(CGAL::squared_distance(*q, guess) < h * h / 16) || !(next * t > smallest_cosine)) {
        h /= 2;
        continue;
      }
      if (!domain_.is_ball()) {
        for (int b = 0; b < 3; ++b) {
          if (b == axis || ((*q)[b] >= box_.min(b) && (*q)[b] <= box_.max(b))) continue;
          if (const auto end = end_on_edge(p, *q, axis, b)) points.push_back(*end);
          return false;
        }
      }
      if (length > 2 * step_ && CGAL::squared_distance(*q, start) < step_ * step_ / 2) return true;
      length += h;
      points.push_back(*q);
      p = *q;
      t = next;
      h = std::min(2 * h, step_);
    }
    return false;
  }

  /// The corner of the surface on the edge of the box that the curve crosses between p and q, in axis b.
  std::optional<Point_3> end_on_edge(const Point_3& p, const Point_3& q, int axis, int b) {
    const double limit = q[b] > box_.max(b) ? box_.max(b) : box_.min(b);
    Point_3 end = p + (limit - p[b]) / (q[b] - p[b]) * (q - p);
    const int c = 3 - axis - b;
    for (int n = 0; n < 20; ++n) {
      std::array<double, 3> x = {end.x(), end.y(), end.z()};
      const auto jet = first_order(traits_, end);
      const double step = -jet.value() / jet.coefficients()[std::size_t(1 + c)];
      at(x, axis) = on_border(end, axis)[axis];
      at(x, b) = limit;
      at(x, c) += step;
      end = Point_3(x[0], x[1], x[2]);
      if (!(CGAL::squared_distance(end, p) <= 4 * step_ * step_)) return std::nullopt;
      if (n > 0 && std::abs(step) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(at(x, c))) break;
    }
    for (const Point_3& corner : corners_)
      if (CGAL::squared_distance(corner, end) < 1e-12 * step_ * step_) return corner;
    corners_.push_back(end);
    return end;
  }

  /// The function that vanishes on the border, or on the plane of a face.
  Jet_3<double, 1> border(const Point_3& p, int axis) const {
    Jet_3<double, 1> g(0.0);
    if (domain_.is_ball()) {
      double squared = 0;
      for (int a = 0; a < 3; ++a) {
        const double d = p[a] - domain_.center()[std::size_t(a)];
        squared += d * d;
        g.coefficients()[std::size_t(1 + a)] = d;
      }
      g.at<0>() = (squared - domain_.radius() * domain_.radius()) / 2;
    } else {
      g.coefficients()[std::size_t(1 + axis)] = 1;
      g.at<0>() = p[axis] - on_border(p, axis)[axis];
    }
    return g;
  }

  /// The nearer one of the planes in axis `axis`; for a ball p itself.
  Point_3 on_border(const Point_3& p, int axis) const {
    if (domain_.is_ball()) return p;
    std::array<double, 3> x = {p.x(), p.y(), p.z()};
    const bool is_upper = 2 * p[axis] > box_.min(axis) + box_.max(axis);
    at(x, axis) = is_upper ? box_.max(axis) : box_.min(axis);
    return Point_3(x[0], x[1], x[2]);
  }

  Vector_3 gradient(const Point_3& p) const { return gradient_of<Vector_3>(first_order(traits_, p)); }

  Vector_3 tangent(const Point_3& p, int axis) const {
    const Vector_3 t = CGAL::cross_product(gradient_of<Vector_3>(border(p, axis)), gradient(p));
    return t / std::sqrt(t.squared_length());
  }

  static double& at(std::array<double, 3>& p, int a) { return p[std::size_t(a)]; }

  const Traits& traits_;
  const Clip_domain_3& domain_;
  const CGAL::Bbox_3 box_;
  const double pitch_, step_;
  Grid traced_, on_face_; // on all faces, on this one
  std::vector<Point_3> corners_;
  std::vector<Curve> curves_;
};

} // namespace equiaffine::internal

#endif
