// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_INITIAL_POINTS_H
#define EQUIAFFINE_SRC_DELAUNAY_INITIAL_POINTS_H

#include "delaunay/feature_balls.h"
#include "delaunay/singular_points.h"
#include <equiaffine/delaunay/internal/certified_seeding.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The points that are inserted into the triangulation before it is refined.
struct Initial_points {
  using Point_3 = Any_function_3::Point_3;

  std::vector<Feature_balls::Ball> balls;       ///< along features first, then around singular points
  std::vector<Feature_balls::Segment> segments; ///< between balls that are neighbors on a feature
  std::vector<Point_3> seeds;                   ///< on the surface
  std::vector<Point_3> scaffold;                ///< away from the surface
  std::vector<Point_3> omitted;                 ///< on features, but too near to others to become vertices
  std::vector<CGAL::Bbox_3> undecided_boxes;    ///< where a part of the surface may have been missed
  bool has_features = false;
};

/// Appends a ball around a singular point of the surface, smaller than a facet and apart from the other balls, and
/// removes the seeds in and near it.
inline void protect_singular_point(const Any_function_3::Point_3& p, double size, Initial_points& points) {
  double radius = 0.4 * size;
  for (const auto& ball : points.balls)
    radius = std::min(radius, 0.9 * (std::sqrt(CGAL::squared_distance(p, ball.center)) - ball.radius));
  if (!(radius > 0)) return;
  points.balls.push_back({p, 0, radius});
  std::erase_if(points.seeds, [&](const auto& q) { return CGAL::squared_distance(p, q) < 2 * radius * radius; });
}

/// Finds points on every component of the surface, and covers features and singular points with balls.
inline Initial_points find_initial_points(const Memoized_function_3& function, const Clip_domain_3& domain,
                                          double radius, const Facet_sizing_field& size,
                                          const std::vector<Feature_curve_3>& features) {
  // Seeds keep these distances from vertices on features, so that the facets beside features can have good angles.
  constexpr double clearance_in_sizes = 0.7, clearance_in_radii = 1.7;
  const Feature_balls covered = cover_features(function, domain, radius, size, features);
  std::vector<Fixed_vertex_3<Any_function_3::Point_3>> vertices;
  for (const auto& ball : covered.balls()) {
    const double clearance = std::min(clearance_in_sizes * size(ball.center), clearance_in_radii * ball.radius);
    vertices.push_back({ball.center, std::max(clearance, covered.least_distance())});
  }
  auto seeding = certified_seeding(function, domain, size, radius, vertices);
  Initial_points points{covered.balls(),          covered.segments(),
                        std::move(seeding.seeds), std::move(seeding.scaffold),
                        covered.omitted(),        std::move(seeding.undecided_boxes),
                        !covered.balls().empty()};
  for (const auto& p : singular_points_in(function, points.undecided_boxes))
    if (domain.contains(p)) protect_singular_point(p, size(p), points);
  return points;
}

} // namespace equiaffine::internal

#endif
