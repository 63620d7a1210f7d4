// SPDX-License-Identifier: GPL-3.0-or-later
// The topology of a triangle mesh, computed from the links of its vertices and the fans of triangles around them.
#ifndef EQUIAFFINE_MESH_MESH_TOPOLOGY_H
#define EQUIAFFINE_MESH_MESH_TOPOLOGY_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/index_sets.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The link of a vertex: for every triangle at the vertex the opposite edge, in the direction of the triangle.
class Vertex_link {
public:
  using Index = std::uint32_t;

  /// Starts the link of another vertex, without edges.
  void begin(Index vertex) {
    vertex_ = vertex;
    edges_.clear();
  }

  /// Adds the edge of a triangle that is opposite to its given corner (0, 1 or 2).
  void add(const std::array<Index, 3>& triangle, std::size_t corner) {
    edges_.emplace_back(triangle[(corner + 1) % 3], triangle[(corner + 2) % 3]);
  }

  /// Sorts the edges, which the functions below require.
  void end() {
    std::sort(edges_.begin(), edges_.end());
    ends_.clear();
    neighbors_.clear();
    for (const auto& [a, b] : edges_) {
      ends_.push_back(b);
      neighbors_.push_back(a);
      neighbors_.push_back(b);
    }
    std::sort(ends_.begin(), ends_.end());
    std::sort(neighbors_.begin(), neighbors_.end());
  }

  Index vertex() const { return vertex_; }

  /// Calls visit(neighbor, n) for every neighbor of the vertex, ascending. n is the number of triangles at their edge.
  template <class Visit>
  void for_each_neighbor(const Visit& visit) const {
    for (auto first = neighbors_.begin(); first != neighbors_.end();) {
      const auto last = std::upper_bound(first, neighbors_.end(), *first);
      visit(*first, std::size_t(last - first));
      first = last;
    }
  }

  /// Whether the triangles around the vertex form one open or closed fan with consistent orientations.
  bool is_path_or_circle() const { return is_union_of_paths_and_circles() && is_connected(); }

private:
  bool is_union_of_paths_and_circles() const {
    if (edges_.empty() || std::binary_search(neighbors_.begin(), neighbors_.end(), vertex_)) return false;
    const auto is_loop = [](const auto& e) { return e.first == e.second; };
    const auto begin_alike = [](const auto& e, const auto& f) { return e.first == f.first; };
    return std::none_of(edges_.begin(), edges_.end(), is_loop) &&
           std::adjacent_find(edges_.begin(), edges_.end(), begin_alike) == edges_.end() &&
           std::adjacent_find(ends_.begin(), ends_.end()) == ends_.end();
  }

  /// Whether one walk covers all edges. It starts at the beginning of a path, or anywhere on a circle.
  bool is_connected() const {
    Index start = edges_.front().first;
    for (const auto& edge : edges_)
      if (!std::binary_search(ends_.begin(), ends_.end(), edge.first)) start = edge.first;
    Index here = start;
    std::size_t passed_edges = 0;
    do {
      const auto edge = std::lower_bound(edges_.begin(), edges_.end(), std::pair(here, Index(0)));
      if (edge == edges_.end() || edge->first != here) break;
      here = edge->second;
      ++passed_edges;
    } while (here != start);
    return passed_edges == edges_.size();
  }

  Index vertex_ = 0;
  std::vector<std::pair<Index, Index>> edges_;
  std::vector<Index> ends_;      // the second vertex of every edge, sorted
  std::vector<Index> neighbors_; // the vertices of every edge, sorted; a neighbor appears once per triangle
};

/// The corners of triangles, sorted by vertex: those at vertex v are corners[first[v]] to corners[first[v + 1] - 1],
/// where 3 t + c denotes corner c of triangle t.
struct Corners_by_vertex {
  Corners_by_vertex(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t number_of_vertices)
      : first(number_of_vertices + 2), corners(3 * triangles.size()) {
    for (const auto& triangle : triangles)
      for (const std::uint32_t v : triangle) ++first[v + 2];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (std::size_t t = 0; t < triangles.size(); ++t)
      for (std::size_t c = 0; c < 3; ++c) corners[first[triangles[t][c] + 1]++] = 3 * t + c;
    first.pop_back();
  }

  std::vector<std::size_t> first, corners;
};

/// Calls visit(link) for every vertex of a list of triangles, ascending. `link.vertex()` is its index,
/// `link.is_path_or_circle()` is whether the mesh is an oriented manifold there, and
/// `link.for_each_neighbor(visit_neighbor)` calls visit_neighbor(neighbor, n) for every edge of the vertex, where n is
/// the number of triangles at the edge. Takes nearly linear time and 32 bytes of memory per triangle.
/// \pre indices are below `number_of_vertices`
template <class Visit>
void for_each_vertex_link(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t number_of_vertices,
                          const Visit& visit) {
  const Corners_by_vertex at(triangles, number_of_vertices);
  Vertex_link link;
  for (std::size_t v = 0; v < number_of_vertices; ++v) {
    link.begin(std::uint32_t(v));
    for (std::size_t n = at.first[v]; n < at.first[v + 1]; ++n)
      link.add(triangles[at.corners[n] / 3], at.corners[n] % 3);
    link.end();
    visit(link);
  }
}

/// An edge of a triangle. Corner m of triangle t is denoted by 3 t + m.
struct Triangle_edge {
  std::uint32_t first, second;             // its vertices, the smaller one first
  std::size_t first_corner, second_corner; // the corners of the triangle at these vertices
  bool is_reversed;                        // whether the triangle traverses it from second to first
  bool operator<(const Triangle_edge& other) const {
    return first != other.first ? first < other.first : second < other.second;
  }
};

/// Partitions the corners of triangles into sets, one for each fan of triangles around a vertex. Triangles are adjacent
/// in a fan if they traverse a common edge in opposite directions and no third triangle has this edge.
template <class Triangles>
Disjoint_sets<std::size_t> corners_by_fan(const Triangles& triangles) {
  std::vector<Triangle_edge> edges;
  for (std::size_t c = 0; c < 3 * triangles.size(); ++c) {
    const std::size_t d = c % 3 == 2 ? c - 2 : c + 1;
    const std::uint32_t a = triangles[c / 3][c % 3], b = triangles[d / 3][d % 3];
    edges.push_back(a < b ? Triangle_edge{a, b, c, d, false} : Triangle_edge{b, a, d, c, true});
  }
  std::sort(edges.begin(), edges.end());
  Disjoint_sets<std::size_t> fans(3 * triangles.size());
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto end = std::find_if(edge, edges.end(), [&](const Triangle_edge& other) { return *edge < other; });
    if (end - edge == 2 && edge[0].is_reversed != edge[1].is_reversed) {
      fans.unite(edge[1].first_corner, edge[0].first_corner);
      fans.unite(edge[1].second_corner, edge[0].second_corner);
    }
    edge = end;
  }
  return fans;
}

/// Gives every fan of triangles its own vertex. Several fans meet in one vertex at edges with more than two triangles,
/// and where parts of a surface meet next to nodes without a value. `copy_vertex(v)` must append a copy of vertex v.
template <class Triangles, class CopyVertex>
void split_fans(Triangles& triangles, std::size_t number_of_vertices, const CopyVertex& copy_vertex) {
  if (triangles.empty()) return;
  auto fans = corners_by_fan(triangles);
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> vertex_of_fan(3 * triangles.size(), none);
  std::vector<bool> is_taken(number_of_vertices, false);
  for (std::size_t c = 0; c < 3 * triangles.size(); ++c) {
    std::uint32_t& corner = triangles[c / 3][c % 3];
    std::uint32_t& vertex = vertex_of_fan[fans.find(c)];
    if (vertex == none) {
      vertex = is_taken[corner] ? std::uint32_t(number_of_vertices++) : corner;
      if (vertex == corner) is_taken[corner] = true;
      else copy_vertex(corner);
    }
    corner = vertex;
  }
}

} // namespace equiaffine::internal

namespace equiaffine {

/// The topology of a list of triangles.
struct Mesh_topology {
  /// Whether every edge is in one triangle, or in two that traverse it in opposite directions, and the triangles around
  /// every point form one open or closed fan. False if there are points in no triangle, or triangles with a repeated
  /// index.
  bool is_manifold = true;
  std::size_t edges = 0;                   ///< the number of edges
  std::size_t boundary_edges = 0;          ///< edges in exactly one triangle
  std::size_t components = 0;              ///< connected via points; a point in no triangle is a component
  std::ptrdiff_t euler_characteristic = 0; ///< points - edges + triangles
};

/// Computes the topology from the indices only: points with equal coordinates are different points. Takes nearly linear
/// time and 32 bytes of memory per triangle. \throw std::invalid_argument if an index is not below `number_of_points`
inline Mesh_topology mesh_topology(std::span<const std::array<std::uint32_t, 3>> triangles,
                                   std::size_t number_of_points) {
  const auto is_valid = [&](const auto& t) { return std::max({t[0], t[1], t[2]}) < number_of_points; };
  check_argument(std::all_of(triangles.begin(), triangles.end(), is_valid),
                 "a triangle has an index that is not below the number of points: pass all points of the mesh");
  Mesh_topology topology;
  internal::for_each_vertex_link(triangles, number_of_points, [&](const auto& link) {
    if (!link.is_path_or_circle()) topology.is_manifold = false;
    link.for_each_neighbor([&](std::uint32_t neighbor, std::size_t triangles_at_edge) {
      if (neighbor <= link.vertex()) return; // each edge is counted at its smaller vertex
      ++topology.edges;
      if (triangles_at_edge == 1) ++topology.boundary_edges;
    });
  });
  topology.components = number_of_points;
  Disjoint_sets<std::uint32_t> connected_points(number_of_points);
  for (const auto& [a, b, c] : triangles) {
    if (connected_points.unite(a, b)) --topology.components;
    if (connected_points.unite(a, c)) --topology.components;
  }
  topology.euler_characteristic =
      std::ptrdiff_t(number_of_points) - std::ptrdiff_t(topology.edges) + std::ptrdiff_t(triangles.size());
  return topology;
}

} // namespace equiaffine

#endif
