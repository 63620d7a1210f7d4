// SPDX-License-Identifier: GPL-3.0-or-later
// Inserts the initial points into the triangulation, and extracts an oriented triangle mesh from its facets.
#ifndef EQUIAFFINE_SRC_DELAUNAY_FACET_MESH_H
#define EQUIAFFINE_SRC_DELAUNAY_FACET_MESH_H

#include "delaunay/Surface_complex.h"
#include "delaunay/initial_points.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/delaunay/delaunay_surface.h>
#include <equiaffine/mesh/mesh_topology.h>
#include <equiaffine/surface/internal/jet_derivatives.h>

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The result of `insert_points`.
struct Inserted_points {
  std::vector<std::pair<Surface_vertex, Surface_vertex>> feature_edges; ///< neighbors on features
  std::vector<Surface_domain_3::Point_3> hidden; ///< points of features and seeds hidden by the balls of other vertices
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

/// Inserts points in spatial order, and returns those that are hidden by balls.
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

/// Inserts the initial points into an empty triangulation. It stays empty if none of them lies on the surface.
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

/// The neighbor of a triangle across an edge that is in no third triangle.
struct Adjacent_triangle {
  std::size_t triangle; ///< index of the neighbor
  bool agrees;          ///< whether both traverse the edge in opposite directions
};

/// The triangles across the edges of each triangle.
inline std::vector<std::vector<Adjacent_triangle>>
adjacent_triangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  struct Side {
    std::uint32_t first, second; // the smaller index first
    bool is_reversed;            // the triangle goes from the larger index to the smaller one
    std::size_t triangle;
  };
  std::vector<Side> sides;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [a, b] = std::pair(triangles[t][i], triangles[t][(i + 1) % 3]);
      sides.push_back({std::min(a, b), std::max(a, b), a > b, t});
    }
  const auto ends = [](const Side& s) { return std::pair(s.first, s.second); };
  std::sort(sides.begin(), sides.end(), [&](const Side& s, const Side& t) {
    return std::tuple(s.first, s.second, s.triangle) < std::tuple(t.first, t.second, t.triangle);
  });
  std::vector<std::vector<Adjacent_triangle>> adjacent(triangles.size());
  for (auto first = sides.begin(); first != sides.end();) {
    const auto last = std::find_if(first, sides.end(), [&](const Side& s) { return ends(s) != ends(*first); });
    if (last - first == 2) {
      const bool agrees = first[0].is_reversed != first[1].is_reversed;
      adjacent[first[0].triangle].push_back({first[1].triangle, agrees});
      adjacent[first[1].triangle].push_back({first[0].triangle, agrees});
    }
    first = last;
  }
  return adjacent;
}

/// Flips the minimum number of triangles per component so that adjacent ones agree. Components are connected by edges
/// that are in exactly two triangles. \pre the components are orientable
inline void orient_triangles(std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const auto adjacent = adjacent_triangles(triangles);
  enum State { UNSEEN, LIKE_FIRST, UNLIKE_FIRST };
  std::vector<State> state(triangles.size(), UNSEEN);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (state[t] != UNSEEN) continue;
    std::vector<std::size_t> component = {t};
    state[t] = LIKE_FIRST;
    for (std::size_t n = 0; n < component.size(); ++n)
      for (const Adjacent_triangle& next : adjacent[component[n]]) {
        if (state[next.triangle] != UNSEEN) continue;
        state[next.triangle] = (state[component[n]] == LIKE_FIRST) == next.agrees ? LIKE_FIRST : UNLIKE_FIRST;
        component.push_back(next.triangle);
      }
    const auto unlike =
        std::count_if(component.begin(), component.end(), [&](std::size_t u) { return state[u] == UNLIKE_FIRST; });
    const State fewer = 2 * std::size_t(unlike) > component.size() ? LIKE_FIRST : UNLIKE_FIRST;
    for (const std::size_t u : component)
      if (state[u] == fewer) std::swap(triangles[u][1], triangles[u][2]);
  }
}

/// The facets of a triangulation that approximate the surface, as triangles with point indices.
struct Facet_mesh {
  using Numbers = std::unordered_map<const void*, std::uint32_t>;

  Delaunay_surface_3<Any_function_3::Kernel> surface;
  Numbers numbers;                 ///< the index of a point, by the address of its vertex
  std::vector<bool> is_on_feature; ///< per point
  Mesh_topology topology;

  Numbers::const_iterator find(Surface_vertex vertex) const { return numbers.find(&*vertex); }
  bool has(Surface_vertex vertex) const { return find(vertex) != numbers.end(); }
};

/// Returns the index of a vertex. The first call for a vertex assigns the next index to it.
inline std::uint32_t number_of(Surface_vertex vertex, Facet_mesh& mesh) {
  const auto [entry, is_new] = mesh.numbers.try_emplace(&*vertex, std::uint32_t(mesh.numbers.size()));
  if (is_new) {
    const auto& p = vertex->point();
    mesh.surface.points.emplace_back(p.x(), p.y(), p.z());
    mesh.is_on_feature.push_back(vertex->in_dimension() < 2);
  }
  return entry->second;
}

/// Returns the facets as triangles that are counterclockwise seen from where f is positive. Near a crease, where
/// gradients do not determine that side, a triangle is oriented like its neighbors.
inline Facet_mesh read_facets(const Surface_complex& complex, const Memoized_function_3& function) {
  using Vector_3 = Any_function_3::Vector_3;
  Facet_mesh mesh;
  auto& [points, triangles] = static_cast<Indexed_triangle_mesh_3<Any_function_3::Kernel>&>(mesh.surface);
  std::vector<Vector_3> gradients;
  for (auto facet = complex.facets_in_complex_begin(); facet != complex.facets_in_complex_end(); ++facet) {
    Progress_observer::step();
    std::array<std::uint32_t, 3> triangle;
    for (int i = 0; i < 3; ++i)
      triangle[std::size_t(i)] = number_of(facet->first->vertex((facet->second + 1 + i) & 3), mesh);
    while (gradients.size() < points.size())
      gradients.push_back(gradient_of<Vector_3>(function.first_order(points[gradients.size()])));
    const auto& [a, b, c] = triangle;
    const Vector_3 normal = CGAL::cross_product(points[b] - points[a], points[c] - points[a]);
    if (normal * (gradients[a] + gradients[b] + gradients[c]) < 0) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
  }
  mesh.surface.vertex_status.assign(points.size(), Point_status::REGULAR);
  mesh.topology = mesh_topology(triangles, points.size());
  if (mesh.topology.is_manifold) return mesh;
  orient_triangles(triangles);
  mesh.topology = mesh_topology(triangles, points.size());
  return mesh;
}

using Lost_points = std::vector<Surface_domain_3::Point_3>;

/// Appends the points where the mesh is not a manifold because parts of the surface, or features, are closer to each
/// other than the size of facets.
inline void append_singular_vertices(const Facet_mesh& mesh, Lost_points& lost) {
  const auto& surface = mesh.surface;
  for_each_vertex_link(surface.triangles, surface.points.size(), [&](const auto& link) {
    const auto& p = surface.points[link.vertex()];
    if (!link.is_path_or_circle()) lost.emplace_back(p.x(), p.y(), p.z());
  });
}

/// Appends the vertices on the surface that are in no triangle.
inline void append_isolated_vertices(const Surface_triangulation& triangulation, const Facet_mesh& mesh,
                                     Lost_points& lost) {
  for (const auto vertex : triangulation.finite_vertex_handles())
    if (vertex->in_dimension() < 3 && !mesh.has(vertex)) lost.push_back(triangulation.point(vertex).point());
}

/// Appends the midpoints between neighbors on a feature that are not joined by an edge of the mesh, except those with
/// a neighbor in no triangle, which is an isolated vertex.
inline void append_missing_feature_edges(const Inserted_points& inserted, const Facet_mesh& mesh, Lost_points& lost) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges; // between points on features, the smaller index first
  for (const auto& t : mesh.surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = t[i], w = t[(i + 1) % 3];
      if (mesh.is_on_feature[v] && mesh.is_on_feature[w]) edges.insert(std::minmax(v, w));
    }
  for (const auto& [v, w] : inserted.feature_edges)
    if (mesh.has(v) && mesh.has(w) && !edges.contains(std::minmax(mesh.find(v)->second, mesh.find(w)->second)))
      lost.push_back(CGAL::midpoint(v->point().point(), w->point().point()));
}

/// Adds the triangle between an edge of a feature and two edges of the border of the mesh. It is not a facet if the
/// center of its surface Delaunay ball would lie beyond the end of the surface.
inline void add_missing_facets(const Inserted_points& inserted, Facet_mesh& mesh) {
  auto& surface = mesh.surface;
  std::set<std::pair<std::uint32_t, std::uint32_t>>
      sides; // of triangles at features, from the first vertex to the second
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = t[i], w = t[(i + 1) % 3];
      if (mesh.is_on_feature[v] || mesh.is_on_feature[w]) sides.emplace(v, w);
    }
  std::unordered_map<std::uint32_t, std::uint32_t> next; // along the border
  for (const auto& [v, w] : sides)
    if (!sides.contains({w, v})) next[v] = w;
  const auto close = [&](std::uint32_t v, std::uint32_t w) {
    const auto middle = next.find(v);
    if (middle == next.end()) return;
    const auto last = next.find(middle->second);
    if (last != next.end() && last->second == w) surface.triangles.push_back({middle->second, v, w});
  };
  for (const auto& [v, w] : inserted.feature_edges) {
    if (!mesh.has(v) || !mesh.has(w)) continue;
    const std::uint32_t p = mesh.find(v)->second, q = mesh.find(w)->second;
    if (sides.contains({p, q}) || sides.contains({q, p})) continue;
    close(p, q);
    close(q, p);
  }
  mesh.topology = mesh_topology(surface.triangles, surface.points.size());
}

} // namespace equiaffine::internal

#endif
