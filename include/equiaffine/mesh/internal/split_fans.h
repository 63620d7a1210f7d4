// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_SPLIT_FANS_H
#define EQUIAFFINE_MESH_INTERNAL_SPLIT_FANS_H

#include <equiaffine/base/internal/disjoint_sets.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// An edge of a triangle. Corner m of triangle t is denoted by 3 t + m.
struct Triangle_edge {
  std::uint32_t first, second;             // its vertices, the smaller one first
  std::size_t first_corner, second_corner; // the corners of the triangle there
  bool is_reversed;                        // whether the triangle passes it from the second vertex to the first
  bool operator<(const Triangle_edge& other) const {
    return first != other.first ? first < other.first : second < other.second;
  }
};

/// The corners of triangles in sets, one for each fan of triangles around a vertex that follow each other by edges. Two
/// triangles follow each other by an edge that they pass in opposite directions, and that is in no third one.
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

} // namespace equiaffine::internal

namespace equiaffine {

/// Gives every fan of triangles a vertex of its own where several fans meet in one vertex, as parts of a surface do
/// beside nodes without a value, and along edges with more than two triangles. `copy_vertex(v)` appends a copy of
/// vertex v.
template <class Triangles, class CopyVertex>
void split_fans(Triangles& triangles, std::size_t number_of_vertices, const CopyVertex& copy_vertex) {
  if (triangles.empty()) return;
  auto fans = internal::corners_by_fan(triangles);
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

} // namespace equiaffine

#endif
