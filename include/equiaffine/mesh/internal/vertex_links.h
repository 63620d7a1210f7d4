// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_VERTEX_LINKS_H
#define EQUIAFFINE_MESH_INTERNAL_VERTEX_LINKS_H

#include <equiaffine/mesh/internal/Vertex_link.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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
