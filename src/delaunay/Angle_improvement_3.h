// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_ANGLE_IMPROVEMENT_3_H
#define EQUIAFFINE_SRC_DELAUNAY_ANGLE_IMPROVEMENT_3_H

#include "delaunay/Surface_criteria_3.h"
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/surface/Clip_domain_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// Improves small angles. Refinement must stop near features and leaves a few triangles with too small angles there.
/// Their vertices are moved on the surface, subject to the other criteria, until all triangles around them have large
/// enough angles.
template <class Function>
class Angle_improvement_3 {
  using Surface = Delaunay_surface_3<Any_function_3::Kernel>;
  using Point_3 = Any_function_3::Point_3;
  using Vector_3 = Any_function_3::Vector_3;
  using Triangle = std::array<std::uint32_t, 3>;

public:
  Angle_improvement_3(const Function& function, const Clip_domain_3& domain, const Delaunay_criteria& criteria,
                      const Facet_sizing_field& size)
      : function_(function), domain_(domain), criteria_(criteria), size_(size),
        least_cosine_(std::cos(criteria.angle * std::numbers::pi / 180)) {}

  /// Vertices with `is_fixed` are not moved. Takes one pass over the triangles if all of them are good.
  void operator()(Surface& surface, const std::vector<bool>& is_fixed) {
    constexpr int sweeps = 10;
    for (int n = 0; n < sweeps; ++n) {
      const auto vertices = vertices_of_bad_triangles(surface, is_fixed);
      if (vertices.empty()) return;
      if (n == 0) find_stars(surface);
      for (const std::uint32_t v : vertices) move(surface, v);
    }
  }

private:
  std::vector<std::uint32_t> vertices_of_bad_triangles(const Surface& surface,
                                                       const std::vector<bool>& is_fixed) const {
    std::vector<std::uint32_t> vertices;
    for (const Triangle& t : surface.triangles)
      if (largest_cosine(surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]) > least_cosine_)
        for (const std::uint32_t v : t)
          if (!is_fixed[v]) vertices.push_back(v);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  /// Collects the opposite edges of the triangles around every vertex.
  void find_stars(const Surface& surface) {
    stars_.resize(surface.points.size());
    for (const Triangle& t : surface.triangles)
      for (std::size_t i = 0; i < 3; ++i) stars_[t[i]].push_back({t[(i + 1) % 3], t[(i + 2) % 3]});
  }

  /// The cosine of the smallest angle of a triangle.
  static double largest_cosine(const Point_3& p, const Point_3& q, const Point_3& r) {
    const double a = CGAL::squared_distance(q, r), b = CGAL::squared_distance(r, p), c = CGAL::squared_distance(p, q);
    const double sum = a + b + c, shortest = std::min({a, b, c}), product = a * b * c;
    return (sum / 2 - shortest) * std::sqrt(shortest / product);
  }

  /// The cosine of the smallest angle in the triangles around vertex v if it were at p; infinite if a triangle would
  /// face against the gradient of f.
  double largest_cosine(const Surface& surface, std::uint32_t v, const Point_3& p, const Vector_3& gradient) const {
    double largest = 0;
    for (const auto& [a, b] : stars_[v]) {
      const Point_3 &q = surface.points[a], &r = surface.points[b];
      if (!(CGAL::cross_product(q - p, r - p) * gradient > 0)) return infinity;
      largest = std::max(largest, largest_cosine(p, q, r));
    }
    return largest;
  }

  /// Whether the triangles around vertex v would satisfy the criteria of distance and size if v were at p.
  bool satisfies_other_criteria(const Surface& surface, std::uint32_t v, const Point_3& p) const {
    return std::all_of(stars_[v].begin(), stars_[v].end(), [&](const auto& edge) {
      const Point_3 center = CGAL::circumcenter(p, surface.points[edge[0]], surface.points[edge[1]]);
      const double distance = distance_estimate(first_order(function_, center)), bound = size_(center);
      return distance <= criteria_.distance && CGAL::squared_distance(center, p) + distance * distance <= bound * bound;
    });
  }

  /// A position for a vertex, and the cosine of the smallest angle around it.
  struct Place {
    Point_3 point;
    double cosine;
  };

  /// Moves a vertex step by step in the direction in which the smallest angle around it grows most. Halves the step
  /// if none improves the angle.
  void move(Surface& surface, std::uint32_t v) const {
    Point_3& p = surface.points[v];
    Vector_3 gradient = gradient_of<Vector_3>(first_order(function_, p));
    Place here = {p, largest_cosine(surface, v, p, gradient)};
    double shortest = infinity;
    for (const auto& edge : stars_[v])
      shortest = std::min(shortest, CGAL::squared_distance(p, surface.points[edge[0]]));
    for (double step = std::sqrt(shortest) / 4, last = step / 16; step > last && here.cosine > least_cosine_;) {
      const auto better = best_place_around(surface, v, here, gradient, step);
      if (!better) {
        step /= 2;
        continue;
      }
      here = *better;
      p = here.point;
      gradient = gradient_of<Vector_3>(first_order(function_, p));
    }
  }

  /// Returns the best position on the surface at about the distance `step` from a vertex, or nothing if none is
  /// clearly better.
  std::optional<Place> best_place_around(const Surface& surface, std::uint32_t v, const Place& here,
                                         const Vector_3& gradient, double step) const {
    constexpr int directions = 8;
    constexpr double least_gain = 1e-3; // of the cosine
    const Vector_3 to_neighbor = surface.points[stars_[v].front()[0]] - here.point;
    const Vector_3 across = CGAL::cross_product(gradient, to_neighbor), along = CGAL::cross_product(across, gradient);
    const Vector_3 x = along / std::sqrt(along.squared_length()), y = across / std::sqrt(across.squared_length());
    std::optional<Place> best;
    for (int n = 0; n < directions; ++n) {
      const double angle = 2 * std::numbers::pi * n / directions;
      const auto q =
          project_to_surface(function_, here.point + step * (std::cos(angle) * x + std::sin(angle) * y), step);
      if (!q.has_converged || !domain_.contains(q.point)) continue;
      const double cosine = largest_cosine(surface, v, q.point, gradient);
      const double bound = best ? best->cosine : here.cosine - least_gain;
      if (cosine < bound && satisfies_other_criteria(surface, v, q.point)) best = Place{q.point, cosine};
    }
    return best;
  }

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  const Function& function_;
  const Clip_domain_3& domain_;
  const Delaunay_criteria& criteria_;
  const Facet_sizing_field& size_;
  const double least_cosine_;
  std::vector<std::vector<std::array<std::uint32_t, 2>>> stars_; // per vertex, the opposite edges of its triangles
};

} // namespace equiaffine::internal

#endif
