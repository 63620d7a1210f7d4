// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_END_CURVES_3_H
#define EQUIAFFINE_SRC_DELAUNAY_END_CURVES_3_H

#include "delaunay/Feature_curve_3.h"
#include <equiaffine/delaunay/Implicit_mesh_domain_3.h>
#include <equiaffine/delaunay/internal/Seed_grid_3.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/Polyline_3.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/internal/curve_step.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Finds the curves where a surface ends within the clip domain, since f is not defined beyond. The border of a mesh is
/// ragged there. From it, paths on the surface lead to the ends, which are joined to polylines.
class End_curves_3 {
  using Kernel = Any_function_3::Kernel;
  using Point_3 = Kernel::Point_3;
  using Vector_3 = Kernel::Vector_3;
  using Domain = Implicit_mesh_domain_3<Any_function_3, Kernel>;
  using Mesh = Indexed_triangle_mesh_3<Kernel>;
  using Points = std::vector<Point_3>;

public:
  /// `radius` bounds the size of facets.
  End_curves_3(const Any_function_3& function, const Clip_domain_3& domain, double radius)
      : function_(function), domain_(domain), radius_(radius),
        intersect_(Domain(function, domain, radius).construct_intersection_with_zero_set_object()) {}

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
  /// The edges of a single triangle each, as its vertices with the opposite one last.
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

  /// Goes to the end of the surface from points beside the edge ab, which is in one triangle only, with the corner c.
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

  /// The last point of a path on the surface, which is as straight as the surface lets it be, if f is not defined right
  /// beyond that point.
  std::optional<Point_3> end_of_path(Point_3 p, Vector_3 direction) const {
    double length = 0;
    for (double step = radius_ / 8; step > precision * radius_;) {
      const Vector_3 gradient = gradient_of<Vector_3>(function_.first_order(p));
      const Vector_3 tangent = direction - (direction * gradient) / gradient.squared_length() * gradient;
      const Point_3 guess = p + step / std::sqrt(tangent.squared_length()) * tangent;
      if (!(guess == guess)) break; // f has no gradient at the end itself
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

  /// A point of the surface on the line through p along the gradient, not further away than `reach`.
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

  /// Ends that are not much nearer to each other than facets are large; those on the border come first.
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

  /// Joins each point with the nearest one ahead. Polylines of less than four points are dropped.
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

  /// Moves points to the end of a line as long as there is one ahead.
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

  /// Whether a line reaches p if it goes on by the size of a facet, and turns by less than 60 degrees.
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
