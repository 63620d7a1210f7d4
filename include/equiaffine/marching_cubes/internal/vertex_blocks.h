// SPDX-License-Identifier: GPL-3.0-or-later
// The blocks of nodes whose vertices a thread projects, one after the other.
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_BLOCKS_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_BLOCKS_H

#include <equiaffine/function/concepts.h>
#include <equiaffine/function/internal/point_blocks.h>
#include <equiaffine/marching_cubes/internal/grid_elements.h>
#include <equiaffine/marching_cubes/internal/isosurface_extraction.h>
#include <equiaffine/volume/Cell_block.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// The number of planes whose vertices are projected together. Where tiles are few, those of more planes are, for
/// threads to have something to do.
template <class Traits>
std::size_t planes_of_slab(const Node_signs::Size& size) {
  constexpr std::size_t planes = cells_of_tile[2], enough_tiles = 64;
  if constexpr (!CellwiseImplicitFunctionTraits_3<Traits>) return planes;
  const std::size_t tiles = ((size[0] - 1) / cells_of_tile[0] + 1) * ((size[1] - 1) / cells_of_tile[1] + 1);
  return planes * std::max<std::size_t>(1, enough_tiles / tiles);
}

/// The blocks of nodes of some planes: tiles for a function that can be restricted to cells, else planes.
template <class Traits>
std::vector<Node_block> blocks_of_slab(const Isosurface_plan& plan, const Index_range& planes) {
  std::vector<Node_block> blocks;
  if constexpr (CellwiseImplicitFunctionTraits_3<Traits>) {
    const auto& size = plan.signs.size();
    for (std::size_t k = planes.first; k < planes.end; k += cells_of_tile[2])
      for (std::size_t j = 0; j < size[1]; j += cells_of_tile[1])
        for (std::size_t i = 0; i < size[0]; i += cells_of_tile[0])
          blocks.push_back({{{i, std::min(i + cells_of_tile[0], size[0])},
                             {j, std::min(j + cells_of_tile[1], size[1])},
                             {k, std::min(k + cells_of_tile[2], planes.end)}}});
  } else {
    for (std::size_t k = planes.first; k < planes.end; ++k) blocks.push_back(plane_of_nodes(plan, k));
  }
  return blocks;
}

/// Calls visit(v, inner_vertex) for every vertex inside a cell that begins at a node of a block.
template <class FT, class Visit>
void for_each_inner_vertex(const Isosurface_plan& plan, const std::vector<Inner_vertex<FT>>& inner_vertices,
                           const Node_block& block, const Visit& visit) {
  for (std::size_t k = block[2].first; k < block[2].end; ++k) {
    const Index_range numbers = plan.numbering.inner_vertices_of_layer(k); // ordered like their cells
    const auto of_layer =
        std::span(inner_vertices).subspan(plan.numbering.place_of_inner(numbers.first, k), numbers.size());
    auto vertex = std::partition_point(of_layer.begin(), of_layer.end(),
                                       [&](const auto& inner) { return inner.cell[1] < block[1].first; });
    for (; vertex != of_layer.end() && vertex->cell[1] < block[1].end; ++vertex)
      if (block[0].first <= vertex->cell[0] && vertex->cell[0] < block[0].end)
        visit(numbers.first + std::size_t(vertex - of_layer.begin()), *vertex);
  }
}

/// The cells around the vertices at the nodes of a block, if it has vertices. Rounding may move a vertex to another
/// cell at its edge, or beyond an end of the edge.
template <class FT>
std::optional<Cell_block> cells_with_vertices(const Isosurface_plan& plan,
                                              const std::vector<Inner_vertex<FT>>& inner_vertices,
                                              const Node_block& block) {
  constexpr std::size_t most = std::numeric_limits<std::size_t>::max();
  const auto& size = plan.signs.size();
  Cell_block cells{{most, most, most}, {0, 0, 0}};
  const auto add = [&](const std::array<std::size_t, 3>& node) {
    for (std::size_t a = 0; a < 3; ++a) {
      cells.first[a] = std::min(cells.first[a], node[a] - std::min<std::size_t>(node[a], 1));
      cells.end[a] = std::max(cells.end[a], std::min(node[a] + 2, size[a] - 1));
    }
  };
  for_each_vertex(plan, block, [&](std::size_t, std::size_t i, std::size_t j, std::size_t k, std::size_t) {
    add({i, j, k});
  });
  for_each_inner_vertex(plan, inner_vertices, block,
                        [&](std::size_t, const Inner_vertex<FT>& inner) { add(inner.cell); });
  return cells.end[0] > 0 ? std::optional(cells) : std::nullopt;
}

} // namespace equiaffine::internal

#endif
