// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_INSERT_POINTS_H
#define EQUIAFFINE_SRC_DELAUNAY_INSERT_POINTS_H

#include "delaunay/Surface_complex.h"
#include "delaunay/initial_points.h"
#include <equiaffine/base/Progress_observer.h>

#include <CGAL/spatial_sort.h>

#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The result of `insert_points`: facts about the vertices on the surface.
struct Inserted_points {
  std::vector<std::pair<Surface_vertex, Surface_vertex>> feature_edges; ///< neighbors on features
  std::vector<Surface_domain_3::Point_3> hidden; ///< points of features and seeds that other vertices leave no room for
};

inline Surface_domain_3::Point_3 to_mesher(const Any_function_3::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// Inserts a point and returns its vertex, or no vertex if the ball of another one hides the point.
inline Surface_vertex insert_point(Surface_complex& complex, const Surface_triangulation::Weighted_point& p,
                                   int dimension, Surface_triangulation::Cell_handle hint = {}) {
  const Surface_vertex vertex = complex.triangulation().insert(p, hint);
  if (vertex == Surface_vertex()) return vertex;
  complex.set_dimension(vertex, dimension);
  complex.set_index(vertex, 1);
  return vertex;
}

/// Inserts points in an order in which neighbors follow each other, and returns those that balls hide.
inline std::vector<Surface_domain_3::Point_3>
insert_sorted(Surface_complex& complex, const std::vector<Any_function_3::Point_3>& points, int dimension) {
  std::vector<Surface_domain_3::Point_3> sorted, hidden;
  for (const auto& p : points) sorted.push_back(to_mesher(p));
  CGAL::spatial_sort(sorted.begin(), sorted.end());
  Surface_triangulation::Cell_handle hint;
  for (const auto& p : sorted) {
    Progress_observer::step();
    const auto vertex = insert_point(complex, Surface_triangulation::Weighted_point(p), dimension, hint);
    if (vertex != Surface_vertex()) hint = vertex->cell();
    else hidden.push_back(p);
  }
  return hidden;
}

/// Inserts the initial points into an empty triangulation. It stays empty if none of them is on the surface.
inline Inserted_points insert_points(Surface_complex& complex, const Initial_points& points) {
  Inserted_points inserted;
  if (points.seeds.empty() && points.balls.empty()) return inserted;
  for (const auto& p : points.omitted) inserted.hidden.push_back(to_mesher(p));
  std::vector<Surface_vertex> vertices;
  for (const auto& ball : points.balls) {
    const Surface_domain_3::Point_3 center = to_mesher(ball.center);
    const Surface_triangulation::Weighted_point weighted(center, ball.radius * ball.radius);
    vertices.push_back(insert_point(complex, weighted, ball.dimension));
    if (vertices.back() == Surface_vertex()) inserted.hidden.push_back(center);
  }
  for (const auto& segment : points.segments) {
    const auto first = vertices[segment.first], second = vertices[segment.second];
    if (first != Surface_vertex() && second != Surface_vertex()) inserted.feature_edges.emplace_back(first, second);
  }
  insert_sorted(complex, points.scaffold, 3);
  const auto hidden = insert_sorted(complex, points.seeds, 2);
  inserted.hidden.insert(inserted.hidden.end(), hidden.begin(), hidden.end());
  return inserted;
}

} // namespace equiaffine::internal

#endif
