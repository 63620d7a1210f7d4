// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_VERTEX_LINKS_H
#define EQUIAFFINE_MESH_INTERNAL_VERTEX_LINKS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The link of a vertex: for every triangle at the vertex its opposite edge, in the triangle's direction.
class Vertex_link {
public:
  using Index = std::uint32_t;

  /// Begins the link of another vertex, still without edges.
  void begin(Index vertex) {
    vertex_ = vertex;
    edges_.clear();
  }

  /// Adds the edge of a triangle that is opposite to its given corner, 0, 1 or 2.
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

  /// Calls visit(neighbor, n) for every neighbor of the vertex, ascending; n triangles contain the edge between them.
  template <class Visit>
  void for_each_neighbor(const Visit& visit) const {
    for (auto first = neighbors_.begin(); first != neighbors_.end();) {
      const auto last = std::upper_bound(first, neighbors_.end(), *first);
      visit(*first, std::size_t(last - first));
      first = last;
    }
  }

  /// Whether the triangles around the vertex form one fan or one closed ring in which neighbors are oriented alike.
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

  /// Whether a walk passes all edges. It starts where a path begins; without a path, anywhere.
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

/// The corners of triangles in the order of their vertices: those at vertex v are corners[first[v]] up to
/// corners[first[v + 1]], where 3 t + c stands for corner c of triangle t.
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

} // namespace equiaffine::internal

namespace equiaffine {

/// Calls visit(link) for every vertex of a list of triangles, ascending. `link.vertex()` is its index,
/// `link.is_path_or_circle()` says whether the mesh is an oriented manifold there, and
/// `link.for_each_neighbor(visit_neighbor)` calls visit_neighbor(neighbor, n) for every edge of the vertex, which is in
/// n triangles. Takes nearly linear time and 32 bytes of memory per triangle.
/// \pre indices are below `number_of_vertices`
template <class Visit>
void for_each_vertex_link(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t number_of_vertices,
                          const Visit& visit) {
  const internal::Corners_by_vertex at(triangles, number_of_vertices);
  internal::Vertex_link link;
  for (std::size_t v = 0; v < number_of_vertices; ++v) {
    link.begin(std::uint32_t(v));
    for (std::size_t n = at.first[v]; n < at.first[v + 1]; ++n)
      link.add(triangles[at.corners[n] / 3], at.corners[n] % 3);
    link.end();
    visit(link);
  }
}

} // namespace equiaffine

#endif
