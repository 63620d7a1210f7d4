// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_SPLIT_FANS_H
#define EQUIAFFINE_MESH_INTERNAL_SPLIT_FANS_H

#include <equiaffine/mesh/internal/corners_by_fan.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

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
