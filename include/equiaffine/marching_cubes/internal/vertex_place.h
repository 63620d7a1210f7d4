// SPDX-License-Identifier: GPL-3.0-or-later
// Vertices of Marching Cubes are known by their places in the grid, whatever part of it they were found in.
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_PLACE_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_PLACE_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/marching_cubes/Vertex_id.h>
#include <equiaffine/marching_cubes/internal/grid_elements.h>
#include <equiaffine/marching_cubes/internal/isosurface_extraction.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// Where a vertex lies: on the edge that begins at a node along the axis `slot`, or, from slot 3 on, in the cell that
/// begins there.
struct Vertex_place {
  std::array<std::size_t, 3> node;
  std::size_t slot;
};

/// The place of inner vertex n, which are ordered like their cells.
template <class FT>
Vertex_place place_of_inner_vertex(const std::vector<Inner_vertex<FT>>& inner_vertices, std::size_t n) {
  const auto& cell = inner_vertices[n].cell;
  std::size_t before = 0;
  while (before < n && inner_vertices[n - before - 1].cell == cell) ++before;
  return {cell, 3 + before};
}

/// The ids of all vertices of a plan.
template <class ConcurrencyTag, class Function, class FT>
std::vector<Vertex_id> vertex_ids(const Function& function, const Isosurface_plan& plan,
                                  const std::vector<Inner_vertex<FT>>& inner_vertices) {
  std::vector<Vertex_id> ids(plan.numbering.number_of_vertices());
  const auto set = [&](std::size_t v, const Vertex_place& place) {
    ids[v] = ids_per_node * Vertex_id(function.index_in_whole(place.node)) + place.slot;
  };
  parallel_for<ConcurrencyTag>(0, plan.numbering.number_of_planes(), [&](std::size_t k) {
    for_each_vertex(plan, plane_of_nodes(plan, k),
                    [&](std::size_t v, std::size_t i, std::size_t j, std::size_t, std::size_t axis) {
                      set(v, {{i, j, k}, axis});
                    });
    const Index_range inner = plan.numbering.inner_vertices_of_layer(k);
    for (std::size_t v = inner.first; v < inner.end; ++v)
      set(v, place_of_inner_vertex(inner_vertices, plan.numbering.place_of_inner(v, k)));
  });
  return ids;
}

/// Gives the copies of a vertex, which follow it, ids of their own.
inline void tell_copies_apart(std::vector<Vertex_id>& ids) {
  constexpr Vertex_id between_copies = 16; // more than the slots of a node
  for (std::size_t v = 1; v < ids.size(); ++v) {
    const Vertex_id before = ids[v - 1];
    if (before / ids_per_node == ids[v] / ids_per_node && before % between_copies == ids[v] % between_copies)
      ids[v] = before + between_copies;
  }
}

} // namespace equiaffine::internal

#endif
