// SPDX-License-Identifier: GPL-3.0-or-later
// Traces the curves in which a surface meets the border of a clip domain, so that the mesh can follow them.
#ifndef EQUIAFFINE_SRC_DELAUNAY_BORDER_CURVES_3_H
#define EQUIAFFINE_SRC_DELAUNAY_BORDER_CURVES_3_H

#include <equiaffine/delaunay/internal/Seed_grid_3.h>
#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>
#include <equiaffine/surface/project_to_surface.h>

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

/// The border of a clip domain: the faces of a box, or a sphere. On the sphere, faces are those of a cube, projected
/// from the center.
template <class Kernel>
class Domain_border_3 {
  using Point_3 = typename Kernel::Point_3;

public:
  struct Face {
    int axis; ///< normal to the face
    bool is_upper;
  };

  explicit Domain_border_3(const Clip_domain_3& domain) : domain_(domain), box_(domain.bbox()) {}

  bool is_sphere() const { return domain_.is_ball(); }
  const CGAL::Bbox_3& box() const { return box_; }

  /// The point of a face with parameters u and v in [0, 1].
  Point_3 point(const Face& face, double u, double v) const {
    return is_sphere() ? point_of_sphere(face, u, v) : point_of_box(face, u, v);
  }

  /// The jet of a function that vanishes on the sphere, or on the plane of the nearer face normal to `axis`.
  Jet_3<double, 1> function(const Point_3& p, int axis) const {
    Jet_3<double, 1> g(0.0);
    if (is_sphere()) {
      double squared = 0;
      for (int a = 0; a < 3; ++a) {
        const double d = p[a] - domain_.center()[std::size_t(a)];
        squared += d * d;
        g.coefficients()[std::size_t(1 + a)] = d;
      }
      g.template at<0>() = (squared - domain_.radius() * domain_.radius()) / 2;
    } else {
      g.coefficients()[std::size_t(1 + axis)] = 1;
      g.template at<0>() = p[axis] - nearer_plane(p, axis);
    }
    return g;
  }

  /// p, moved into the plane of the nearer face normal to `axis`; p itself on a sphere.
  Point_3 snap(const Point_3& p, int axis) const {
    if (is_sphere()) return p;
    std::array<double, 3> x = {p.x(), p.y(), p.z()};
    at(x, axis) = nearer_plane(p, axis);
    return Point_3(x[0], x[1], x[2]);
  }

  /// Returns the axes other than `axis` along which p lies outside the box; none for a sphere.
  std::vector<int> axes_beyond(const Point_3& p, int axis) const {
    std::vector<int> axes;
    for (int b = 0; b < 3 && !is_sphere(); ++b)
      if (b != axis && !(p[b] >= box_.min(b) && p[b] <= box_.max(b))) axes.push_back(b);
    return axes;
  }

  static double& at(std::array<double, 3>& p, int a) { return p[std::size_t(a)]; }

private:
  double nearer_plane(const Point_3& p, int axis) const {
    const bool is_upper = 2 * p[axis] > box_.min(axis) + box_.max(axis);
    return is_upper ? box_.max(axis) : box_.min(axis);
  }

  Point_3 point_of_box(const Face& face, double u, double v) const {
    const int b = (face.axis + 1) % 3, c = (face.axis + 2) % 3;
    std::array<double, 3> p;
    at(p, face.axis) = face.is_upper ? box_.max(face.axis) : box_.min(face.axis);
    at(p, b) = std::lerp(box_.min(b), box_.max(b), u);
    at(p, c) = std::lerp(box_.min(c), box_.max(c), v);
    return Point_3(p[0], p[1], p[2]);
  }

  Point_3 point_of_sphere(const Face& face, double u, double v) const {
    const int b = (face.axis + 1) % 3, c = (face.axis + 2) % 3;
    std::array<double, 3> p;
    const auto slope = [](double t) { return std::tan(std::numbers::pi / 2 * (t - 0.5)); };
    const double x = slope(u), y = slope(v), scale = domain_.radius() / std::sqrt(1 + x * x + y * y);
    at(p, face.axis) = domain_.center()[std::size_t(face.axis)] + (face.is_upper ? scale : -scale);
    at(p, b) = domain_.center()[std::size_t(b)] + x * scale;
    at(p, c) = domain_.center()[std::size_t(c)] + y * scale;
    return Point_3(p[0], p[1], p[2]);
  }

  const Clip_domain_3& domain_;
  const CGAL::Bbox_3 box_;
};

/// Follows a curve in which a surface meets the border of a clip domain from a point of it, by short steps along the
/// tangent. On a box, a curve belongs to a face, normal to an axis, and ends on its edges; the curves of both faces
/// at an edge share the same end.
template <ImplicitFunctionTraits_3 Traits>
class Border_curve_tracer_3 {
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using Border = Domain_border_3<Kernel>;

public:
  /// `step` is the maximum length of a step, `reach` the maximum distance by which a projection moves a point.
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
      if (!(CGAL::squared_distance(p, start) <= reach_ * reach_)) return std::nullopt; // also for NaN
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

  /// The whole curve through one of its points.
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
    std::vector<Point_3> points; // without the start
    bool leads_back;             // whether it ends at the start
  };

  /// Follows the curve in one direction to its end or back to the start.
  Half_curve follow(const Point_3& start, int axis, double direction) {
    std::vector<Point_3> points;
    Point_3 p = start;
    Vector_3 t = direction * tangent(p, axis);
    double length = 0;
    for (double h = step_; h > step_ / 100 && t == t;) { // a tangent of NaN ends the curve
      const Point_3 guess = p + h * t;
      const auto q = project(guess, axis);
      if (!q) // f may be undefined outside the box
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

  /// Whether a step along tangent t ended near the curve, and the tangent there is nearly t.
  static bool is_good_step(const Point_3& guess, const Point_3& q, const Vector_3& t, const Vector_3& next, double h) {
    constexpr double smallest_cosine = 0.95;
    return CGAL::squared_distance(q, guess) < h * h / 16 && next * t > smallest_cosine;
  }

  /// The end of the curve between p and q, which lies outside the box along axis b, by Newton's method for f on the
  /// edge of the box. Curves that end at the same place get the same point.
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

template <class Kernel>
struct Border_curve_3 : Polyline_3<Kernel> {
  int axis; ///< normal to the face of the box; for a sphere, to the face of the cube where the curve was found
};

/// The curves in which a surface meets the border of a clip domain, as polylines of short segments with vertices on
/// both. A curve ends on an edge of a box, and the curves on both sides of the edge share that end.
///
/// A curve with bends smaller than `spacing`, or a closed curve smaller than that, may be missed.
template <ImplicitFunctionTraits_3 Traits>
class Border_curves_3 {
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using Border = Domain_border_3<Kernel>;
  using Face = typename Border::Face;
  using Grid = Seed_grid_3<Point_3, Vector_3>;
  using Seed = typename Grid::Seed;

public:
  using Curve = Border_curve_3<Kernel>;

  Border_curves_3(const Traits& traits, const Clip_domain_3& domain, double spacing)
      : traits_(traits), border_(domain), pitch_(spacing / 2), step_(spacing / 8),
        tracer_(traits, border_, step_, pitch_) {}
  Border_curves_3(const Border_curves_3&) = delete; // the tracer refers to the border

  std::vector<Curve> find() {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool is_upper : {false, true}) {
        if (traced_.empty() || !border_.is_sphere()) traced_.emplace_back();
        search({axis, is_upper}, {0, 1}, {0, 1});
      }
    return std::move(curves_);
  }

  /// Returns the point of a curve near p, or nothing if there is none within half the spacing. `axis` is the axis of
  /// the curve.
  std::optional<Point_3> project(const Point_3& p, int axis) const {
    const auto q = tracer_.project(p, axis);
    return q && border_.axes_beyond(*q, axis).empty() ? q : std::nullopt;
  }

private:
  using Range = std::pair<double, double>;

  /// Finds the curves in a part of a face by subdivision until the parts are small or without surface.
  void search(const Face& face, const Range& u, const Range& v) {
    const std::array<Point_3, 4> corners = {
        border_.point(face, u.first, v.first), border_.point(face, u.second, v.first),
        border_.point(face, u.second, v.second), border_.point(face, u.first, v.second)};
    CGAL::Bbox_3 box;
    for (const Point_3& corner : corners) box += corner.bbox();
    const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
    if (is_empty(box, border_.is_sphere() ? diagonal / 2 : 0)) return;
    if (diagonal <= pitch_) return search_sides(face, corners);
    const double s = (u.first + u.second) / 2, t = (v.first + v.second) / 2;
    for (const Range& u_half : {Range(u.first, s), Range(s, u.second)})
      for (const Range& v_half : {Range(v.first, t), Range(t, v.second)}) search(face, u_half, v_half);
  }

  /// Finds the curves that cross the sides of a small part of a face.
  void search_sides(const Face& face, const std::array<Point_3, 4>& corners) {
    std::array<double, 4> value;
    for (std::size_t n = 0; n < 4; ++n) value[n] = traits_.value(corners[n]);
    for (std::size_t n = 0, m = 1; n < 4; ++n, m = (m + 1) % 4) {
      if (!is_sign_change(value[n], value[m])) continue;
      const auto root = intersect_segment(traits_, corners[n], corners[m], value[n], value[m]);
      if (!root.has_converged) continue;
      const auto start = project(root.point, face.axis);
      if (start && !is_traced(*start, face.axis)) add({tracer_.trace(*start, face.axis), face.axis});
    }
  }

  /// Whether there is no surface in a box enlarged by a margin.
  bool is_empty(const CGAL::Bbox_3& b, double margin) const {
    if constexpr (BoundedImplicitFunctionTraits_3<Traits>)
      return !traits_
                  .bounds(CGAL::Bbox_3(b.xmin() - margin, b.ymin() - margin, b.zmin() - margin, b.xmax() + margin,
                                       b.ymax() + margin, b.zmax() + margin))
                  .contains(0);
    else return false;
  }

  /// Whether an already traced curve of the same face passes near p. A curve in an edge of the box belongs to two
  /// faces, and is only traced on the first one.
  bool is_traced(const Point_3& p, int axis) {
    const Seed seed = seed_at(p);
    if (traced_.back().is_crowded(seed)) return true;
    return runs_in_edge(p, axis) &&
           std::any_of(traced_.begin(), traced_.end(), [&](Grid& grid) { return grid.is_crowded(seed); });
  }

  bool runs_in_edge(const Point_3& p, int axis) const {
    if (border_.is_sphere()) return false;
    constexpr double negligible = 1e-6;
    const CGAL::Bbox_3& box = border_.box();
    const Vector_3 t = tracer_.tangent(p, axis);
    for (int b = 0; b < 3; ++b) {
      const double distance = std::min(std::abs(p[b] - box.min(b)), std::abs(p[b] - box.max(b)));
      if (b != axis && distance < negligible * step_ && std::abs(t[b]) < negligible) return true;
    }
    return false;
  }

  Seed seed_at(const Point_3& p) const { return {p, tracer_.gradient(p), pitch_}; }

  void add(Curve curve) {
    for (const Point_3& p : curve.points) traced_.back().insert(seed_at(p));
    if (!curve.is_closed) {
      drop_neighbors_of_ends(curve.points);
      if (is_short(curve.points.front(), curve.points.back())) return;
    }
    curves_.push_back(std::move(curve));
  }

  bool is_short(const Point_3& p, const Point_3& q) const { return CGAL::squared_distance(p, q) < step_ * step_ / 100; }

  /// Drops points very close to the ends of an open curve: a step may stop just before an edge of the box, or the
  /// curve may have been found there.
  void drop_neighbors_of_ends(std::vector<Point_3>& p) const {
    while (p.size() > 2 && is_short(p[0], p[1])) p.erase(p.begin() + 1);
    while (p.size() > 2 && is_short(p[p.size() - 1], p[p.size() - 2])) p.erase(p.end() - 2);
  }

  const Traits& traits_;
  const Border border_;
  const double pitch_, step_; // size of the parts of faces that are searched; length of segments
  Border_curve_tracer_3<Traits> tracer_;
  std::vector<Grid> traced_; // points of the curves, per face of the box, or of the whole sphere
  std::vector<Curve> curves_;
};

} // namespace equiaffine::internal

#endif
