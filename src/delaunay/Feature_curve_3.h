// SPDX-License-Identifier: GPL-3.0-or-later
// The curves on a surface that the mesh follows: given curves, parabolic curves, and those where the surface ends.
#ifndef EQUIAFFINE_SRC_DELAUNAY_FEATURE_CURVE_3_H
#define EQUIAFFINE_SRC_DELAUNAY_FEATURE_CURVE_3_H

#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/delaunay/internal/Seed_grid_3.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>
#include <equiaffine/surface/parabolic_curves.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A curve on the surface that becomes a chain of edges of the mesh.
struct Feature_curve_3 {
  using Kernel = Any_function_3::Kernel;
  using Point_3 = Kernel::Point_3;

  Polyline_3<Kernel> polyline;
  std::function<std::optional<Point_3>(const Point_3&)> project; ///< to a nearby point of the curve, if there is one
  bool reaches_border = false; ///< an end near the border of the clip domain is extended to it
};

/// The features given by the caller as polylines.
inline std::vector<Feature_curve_3> given_features(const Any_function_3& function, const Meshing_request_3& request) {
  const auto project = [function, reach = request.criteria.radius](const Any_function_3::Point_3& p) {
    const auto found = project_to_surface(function, p, reach);
    return found.has_converged ? std::optional(found.point) : std::nullopt;
  };
  std::vector<Feature_curve_3> features;
  for (const auto& curve : request.feature_curves) features.push_back({curve, project, false});
  return features;
}

/// Appends the parabolic curves of the surface to its features.
inline void append_parabolic_features(const Any_function_3& function,
                                      const std::vector<Polyline_3<Any_function_3::Kernel>>& curves, double reach,
                                      std::vector<Feature_curve_3>& features) {
  const auto project = [function, reach](const Any_function_3::Point_3& p) {
    return project_to_parabolic_curve(function, p, reach * reach);
  };
  for (const auto& curve : curves) features.push_back({curve, project, true});
}

/// Connects the ends of features to the curves in which the surface meets the border of the clip domain.
class Feature_ends_3 {
  using Kernel = Any_function_3::Kernel;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;

public:
  /// `size` is the maximum size of facets.
  Feature_ends_3(const Clip_domain_3& domain, double size) : domain_(domain), size_(size) {}

  /// Extends an open curve at those ends from which it reaches the border within the size of a facet.
  void extend(Feature_curve_3& curve) {
    auto& points = curve.polyline.points;
    if (curve.polyline.is_closed || points.size() < 2) return;
    for (int n = 0; n < 2; ++n) {
      std::reverse(points.begin(), points.end());
      extend_last(curve);
    }
  }

  bool is_on_border(const Point_3& p) const { return std::find(ends_.begin(), ends_.end(), p) != ends_.end(); }

  /// Splits a curve on the border at the ends of the curves that `extend` has extended.
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

  /// Inserts the ends that lie on a curve, up to the distance of chords from the curve, and returns them.
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

  /// A side of the box; ignored for a ball, which has only one side.
  struct Side {
    int axis;
    bool is_upper;
  };

  /// The side beyond which p is farthest.
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

  /// Returns the point where the curve from `before` to its last point p leaves the domain, or nothing if it does not
  /// within the size of a facet.
  std::optional<Point_3> end_on_border(const Feature_curve_3& curve, const Point_3& before, const Point_3& p) const {
    const Vector_3 direction = p - before;
    const Point_3 guess = p + size_ / std::sqrt(direction.squared_length()) * direction;
    const auto beyond = curve.project(guess);
    if (!beyond || domain_.contains(*beyond) || CGAL::squared_distance(*beyond, guess) > size_ * size_ / 4) return {};
    return intersect_side(curve, p, *beyond);
  }

  /// Returns the point where the curve meets the border between a point inside and one outside the domain, by the
  /// Illinois variant of regula falsi.
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

  /// Returns p, moved into a side of the box; p itself for a ball.
  Point_3 on_side(const Point_3& p, const Side& side) const {
    if (domain_.is_ball()) return p;
    std::array<double, 3> x = {p.x(), p.y(), p.z()};
    const CGAL::Bbox_3& box = domain_.bbox();
    x[std::size_t(side.axis)] = side.is_upper ? box.max(side.axis) : box.min(side.axis);
    return Point_3(x[0], x[1], x[2]);
  }

  const Clip_domain_3& domain_;
  const double size_;
  std::vector<Point_3> ends_; // the ends on the border of the extended curves
};

/// Finds the curves where a surface ends within the clip domain because f is undefined beyond them. The border of a
/// mesh is ragged there. Paths on the surface lead from it to the ends, which are joined to polylines.
class End_curves_3 {
  using Kernel = Any_function_3::Kernel;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;
  using Domain = Implicit_mesh_domain_3<Any_function_3, Kernel>;
  using Mesh = Indexed_triangle_mesh_3<Kernel>;
  using Points = std::vector<Point_3>;

public:
  /// `radius` is the maximum radius of facets.
  End_curves_3(const Any_function_3& function, const Clip_domain_3& domain, double radius)
      : function_(function), domain_(domain), radius_(radius),
        intersect_(Domain(function, {.clip = domain, .radius = radius}).construct_intersection_with_zero_set_object()) {
  }

  std::vector<Feature_curve_3> find(const Mesh& mesh) {
    for (const Point_3& p : mesh.points)
      if (is_on_border(p) && is_beside_undefined(p)) ends_.push_back(p);
    for (const auto& [a, b, opposite] : boundary_edges(mesh))
      find_ends(mesh.points[a], mesh.points[b], mesh.points[opposite]);
    const auto project = [ends = ends_, reach = radius_ / 2](const Point_3& p) { return nearest(ends, p, reach); };
    std::vector<Feature_curve_3> curves;
    for (auto& polyline : joined(spaced())) curves.push_back({std::move(polyline), project});
    return curves;
  }

private:
  /// The edges that are in only one triangle, each with the opposite vertex in the last place.
  static std::vector<std::array<std::uint32_t, 3>> boundary_edges(const Mesh& mesh) {
    std::vector<std::array<std::uint32_t, 3>> edges;
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
        edges.push_back({a, b, t[(i + 2) % 3]});
      }
    std::sort(edges.begin(), edges.end());
    const auto is_same = [](const auto& e, const auto& f) { return e[0] == f[0] && e[1] == f[1]; };
    std::vector<std::array<std::uint32_t, 3>> result;
    for (auto first = edges.begin(); first != edges.end();) {
      const auto last = std::find_if(first, edges.end(), [&](const auto& e) { return !is_same(e, *first); });
      if (last - first == 1) result.push_back(*first);
      first = last;
    }
    return result;
  }

  /// Follows paths to the end of the surface from points near the edge ab, which is in only one triangle, with vertex
  /// c.
  void find_ends(const Point_3& a, const Point_3& b, const Point_3& c) {
    if (is_on_border(a) && is_on_border(b)) return;
    const Vector_3 along = b - a, across = a - c;
    const Vector_3 outwards = across - (across * along) / along.squared_length() * along;
    const int pieces = 1 + int(4 * std::sqrt(along.squared_length()) / radius_);
    for (int n = 0; n <= pieces; ++n) {
      const Point_3 p = a + double(n) / pieces * along;
      const bool is_vertex = n == 0 || n == pieces;
      if (is_vertex && is_on_border(p)) continue;
      const auto start = is_vertex ? std::optional(p) : project(p + (c - p) / 4, radius_);
      if (!start) continue;
      if (const auto end = end_of_path(*start, outwards)) ends_.push_back(*end);
    }
  }

  /// The last point of a path on the surface that is as straight as the surface allows, if f is undefined right
  /// beyond that point.
  std::optional<Point_3> end_of_path(Point_3 p, Vector_3 direction) const {
    double length = 0;
    for (double step = radius_ / 8; step > precision * radius_;) {
      const Vector_3 gradient = gradient_of<Vector_3>(function_.first_order(p));
      const Vector_3 tangent = direction - (direction * gradient) / gradient.squared_length() * gradient;
      const Point_3 guess = p + step / std::sqrt(tangent.squared_length()) * tangent;
      if (!(guess == guess)) break; // f has no gradient at the end
      if (!domain_.contains(guess) || length > 2 * radius_) return std::nullopt;
      if (const auto next = project(guess, step / 2)) {
        direction = *next - p;
        p = *next;
        length += step;
      } else {
        step /= 2;
      }
    }
    return is_beside_undefined(p) ? std::optional(p) : std::nullopt;
  }

  /// A point of the surface on the line through p along the gradient, at most `reach` away.
  std::optional<Point_3> project(const Point_3& p, double reach) const {
    const Vector_3 gradient = gradient_of<Vector_3>(function_.first_order(p));
    const double norm = std::sqrt(gradient.squared_length());
    if (!(norm > 0 && std::isfinite(norm))) return std::nullopt;
    const auto [q, index, dimension] = intersect_.find(p, gradient / norm, -reach, reach);
    return dimension == 2 ? std::optional(q) : std::nullopt;
  }

  /// Whether p is on the border of the clip domain.
  bool is_on_border(const Point_3& p) const {
    constexpr double rounding = 1e-9;
    const CGAL::Bbox_3& b = domain_.bbox();
    const Point_3 center((b.xmin() + b.xmax()) / 2, (b.ymin() + b.ymax()) / 2, (b.zmin() + b.zmax()) / 2);
    return !domain_.contains(p + rounding * (p - center));
  }

  bool is_beside_undefined(const Point_3& p) const {
    const double distance = 2 * precision * radius_;
    for (const double x : {-distance, 0.0, distance})
      for (const double y : {-distance, 0.0, distance})
        for (const double z : {-distance, 0.0, distance}) {
          const Point_3 q = p + Vector_3(x, y, z);
          if (domain_.contains(q) && std::isnan(function_.value(q))) return true;
        }
    return false;
  }

  /// The ends, thinned to a spacing of about a facet; those on the border take precedence.
  Points spaced() const {
    const double spacing = radius_ / 4;
    Seed_grid_3<Point_3, Vector_3> grid;
    Points result;
    for (const Point_3& p : ends_) {
      if (grid.is_crowded({p, Vector_3(0, 0, 0), spacing})) continue;
      grid.insert({p, Vector_3(0, 0, 0), spacing});
      result.push_back(p);
    }
    return result;
  }

  /// Joins each point with the nearest one ahead. Polylines of fewer than four points are dropped.
  std::vector<Polyline_3<Kernel>> joined(Points points) const {
    std::vector<Polyline_3<Kernel>> polylines;
    while (!points.empty()) {
      Points line = {points.back()};
      points.pop_back();
      extend(line, points);
      std::reverse(line.begin(), line.end());
      extend(line, points);
      if (line.size() < 4) continue;
      const bool is_closed = is_ahead(line.front(), line);
      polylines.push_back({std::move(line), is_closed});
    }
    return polylines;
  }

  /// Moves points to the end of a line while there is one ahead.
  void extend(Points& line, Points& points) const {
    while (true) {
      auto next = points.end();
      for (auto p = points.begin(); p != points.end(); ++p)
        if (is_ahead(*p, line) && (next == points.end() || is_nearer(*p, *next, line.back()))) next = p;
      if (next == points.end()) return;
      line.push_back(*next);
      points.erase(next);
    }
  }

  /// Whether p is at most a facet size away from the end of a line and requires a turn of less than 60 degrees.
  bool is_ahead(const Point_3& p, const Points& line) const {
    const Vector_3 step = p - line.back();
    if (step.squared_length() > radius_ * radius_) return false;
    if (line.size() < 2) return true;
    const Vector_3 last = line.back() - line[line.size() - 2];
    return 2 * (step * last) > std::sqrt(step.squared_length() * last.squared_length());
  }

  static bool is_nearer(const Point_3& p, const Point_3& q, const Point_3& to) {
    return CGAL::squared_distance(p, to) < CGAL::squared_distance(q, to);
  }

  static std::optional<Point_3> nearest(const Points& points, const Point_3& p, double reach) {
    const auto q = std::min_element(points.begin(), points.end(),
                                    [&](const Point_3& r, const Point_3& s) { return is_nearer(r, s, p); });
    return CGAL::squared_distance(p, *q) < reach * reach ? std::optional(*q) : std::nullopt;
  }

  static constexpr double precision = 1e-3; // of ends, relative to the size of facets

  const Any_function_3& function_;
  const Clip_domain_3& domain_;
  const double radius_;
  const Domain::Construct_intersection intersect_;
  Points ends_;
};

} // namespace equiaffine::internal

#endif
