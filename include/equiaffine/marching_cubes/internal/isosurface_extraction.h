// SPDX-License-Identifier: GPL-3.0-or-later
// Passes over the vertices and the triangles of a plan.
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_EXTRACTION_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_EXTRACTION_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/marching_cubes/Marching_cubes_options.h>
#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>
#include <equiaffine/marching_cubes/internal/isosurface_plan.h>
#include <equiaffine/marching_cubes/internal/marching_cubes_cases.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace equiaffine::internal {

/// The vertices of one cell, in the slots of Case_table. They are updated incrementally along a row of cells. The
/// slot of an edge without a vertex has the next vertex along the row on such an edge.
class Cell_vertices {
public:
  using Index = Isosurface_numbering::Index;
  using Crossed = Case_table::Crossed_edges;

  /// Looks up the vertices on the edges that begin at the lower end of a cell.
  void start_at(const Isosurface_numbering& numbering, std::size_t i, std::size_t j, std::size_t k) {
    constexpr std::size_t axes[8] = {0, 0, 0, 0, 1, 1, 2, 2}, dj[8] = {0, 1, 0, 1, 0, 0, 0, 1},
                          dk[8] = {0, 0, 1, 1, 0, 1, 0, 0};
    for (std::size_t n = 0; n < 8; ++n) slots_[n] = numbering.vertex_from(i, j + dj[n], k + dk[n], axes[n]);
  }

  /// Sets the vertices at the upper end of the cell: an edge there follows the edge at the lower end in its row.
  void enter_cell(const Crossed& crossed) {
    for (std::size_t n = lower; n < upper; ++n) slots_[n + upper - lower] = slots_[n] + crossed[n];
  }

  /// Moves to the next cell of the row, whose lower end is the upper end of this one.
  void leave_cell(const Crossed& crossed) {
    for (std::size_t n = 0; n < lower; ++n) slots_[n] += crossed[n];
    for (std::size_t n = lower; n < upper; ++n) slots_[n] = slots_[n + upper - lower];
  }

  std::size_t first_inner() const { return slots_[inner]; }

  /// Sets the inner vertices of the cell, which have consecutive indices.
  void set_first_inner(std::size_t vertex) {
    for (std::size_t n = 0; n < 3; ++n) slots_[inner + n] = Index(vertex + n);
  }

  Index operator[](std::uint8_t slot) const { return slots_[slot]; }

private:
  static constexpr std::size_t lower = Case_table::first_lower_slot, upper = Case_table::first_upper_slot,
                               inner = Case_table::first_inner_slot;

  std::array<Index, Case_table::number_of_slots> slots_{};
};

using Index_triangle = std::array<Isosurface_numbering::Index, 3>;

/// Implements for_each_vertex().
template <bool HasUndefined, class Place>
void visit_vertices(const Isosurface_plan& plan, const Node_block& block, const Place& place) {
  const Node_signs& signs = plan.signs;
  for (std::size_t k = block[2].first; k < block[2].end; ++k)
    for (std::size_t j = block[1].first; j < block[1].end; ++j) {
      if (!plan.numbering.has_vertices(j, k)) continue;
      auto vertex = plan.numbering.row(j, k).first;
      const Node_signs::Edge_row<HasUndefined> edges(signs, j, k);
      signs.for_each_word(j, k, [&](std::size_t w) {
        if (64 * w >= block[0].end) return;
        const auto crossed = edges.crossed(w);
        if ((crossed[0] | crossed[1] | crossed[2]) == 0) return;
        const auto visit_along = [&](auto axis) {
          if (64 * w < block[0].first) vertex[axis] += Isosurface_numbering::Index(std::popcount(crossed[axis]));
          else
            for (Node_signs::Word bits = crossed[axis]; bits != 0; bits &= bits - 1)
              place(vertex[axis]++, 64 * w + std::size_t(std::countr_zero(bits)), j, k, axis);
        };
        visit_along(std::integral_constant<std::size_t, 0>());
        visit_along(std::integral_constant<std::size_t, 1>());
        visit_along(std::integral_constant<std::size_t, 2>());
      });
    }
}

/// Calls place(vertex, i, j, k, axis) for every vertex on an edge that begins at a node of a block. The block must
/// begin and end with a word of signs or a row. (i, j, k) is the node at which the edge begins; `axis` is a
/// std::integral_constant.
template <class Place>
void for_each_vertex(const Isosurface_plan& plan, const Node_block& block, const Place& place) {
  plan.has_undefined ? visit_vertices<true>(plan, block, place) : visit_vertices<false>(plan, block, place);
}

/// All nodes in plane k.
inline Node_block plane_of_nodes(const Isosurface_plan& plan, std::size_t k) {
  const auto& size = plan.signs.size();
  return {{{0, size[0]}, {0, size[1]}, {k, k + 1}}};
}

/// Calls visit(vertices, edges) for batches of up to 64 vertices on edges that begin at nodes of a block.
template <class Visit>
void for_each_batch(const Isosurface_plan& plan, const Node_block& block, const Visit& visit) {
  constexpr std::size_t batch = 64;
  std::vector<std::size_t> vertices;
  std::vector<Grid_edge> edges;
  const auto visit_batch = [&] {
    visit(std::span<const std::size_t>(vertices), std::span<const Grid_edge>(edges));
    vertices.clear();
    edges.clear();
  };
  for_each_vertex(plan, block, [&](std::size_t v, std::size_t i, std::size_t j, std::size_t k, std::size_t axis) {
    vertices.push_back(v);
    edges.push_back({{i, j, k}, axis});
    if (edges.size() == batch) visit_batch();
  });
  if (!edges.empty()) visit_batch();
}

/// Writes the n triangles of a cell, whose vertices have the given slots. If there is room, it always writes at least
/// triangles_of_most_cells triangles: overwriting the excess later costs less than a mispredicted branch.
inline void write_triangles_of_cell(const Cell_vertices& vertices, const std::uint8_t* slot, std::size_t n,
                                    Index_triangle* out, const Index_triangle* end) {
  std::size_t t = 0;
  const auto write_one = [&] {
    out[t] = {vertices[slot[3 * t]], vertices[slot[3 * t + 1]], vertices[slot[3 * t + 2]]};
    ++t;
  };
  if (std::size_t(end - out) >= Case_table::triangles_of_most_cells)
    while (t < Case_table::triangles_of_most_cells) write_one();
  while (t < n) write_one();
}

/// Writes the triangles of the cells between planes k and k + 1; see write_triangles() for the arguments.
template <bool HasUndefined, class PlaceInner>
void write_triangles_of_layer(const Isosurface_plan& plan, std::size_t k, Index_triangle* triangles,
                              bool is_left_handed, Grid_rows& rows, const PlaceInner& place_inner) {
  const auto& cases = Marching_cubes_cases::instance();
  const auto& table = plan.table;
  const Isosurface_numbering& numbering = plan.numbering;
  const Index_range range = numbering.triangles_of_layer(k);
  Index_triangle* out = triangles + range.first;
  const Index_triangle* const end = triangles + range.end;
  const std::uint8_t* const slots = table.slots[is_left_handed].data();
  const std::uint16_t* next_sub_case = plan.sub_cases[k].data();
  Cell_vertices vertices;
  vertices.set_first_inner(numbering.inner_vertices_of_layer(k).first);
  for (std::size_t j = 0; j + 1 < plan.signs.size()[1]; ++j) {
    if (numbering.row(j, k).triangles == 0) continue;
    // If all nodes have values, every vertex of these rows is in a visited cell, and vertices are counted from cell
    // to
    // cell. Otherwise some vertices are only in cells of other rows, and every cell looks them up.
    if constexpr (!HasUndefined) vertices.start_at(numbering, 0, j, k);
    for_each_active_cell<HasUndefined>(plan.signs, j, k, [&](std::size_t i, unsigned corner_signs) {
      if constexpr (HasUndefined) vertices.start_at(numbering, i, j, k);
      const auto& crossed = table.crossed[corner_signs];
      vertices.enter_cell(crossed);
      const Case_table::Entry* entry = &table.of_signs[corner_signs];
      std::size_t sub_case = 0; // used for inner vertices, which only ambiguous cells have
      if (entry->is_ambiguous) {
        sub_case = *next_sub_case++;
        entry = &table.of_sub_case[sub_case];
      }
      write_triangles_of_cell(vertices, slots + entry->first_slot, entry->triangles, out, end);
      if (entry->inner_vertices > 0) {
        const std::span<const Index_triangle> written(out, entry->triangles);
        if (place_inner(vertices.first_inner(), i, j, k, cases[sub_case].inner_edges, written)) rows.add(j, k);
        vertices.set_first_inner(vertices.first_inner() + entry->inner_vertices);
      }
      out += entry->triangles;
      vertices.leave_cell(crossed);
    });
  }
}

/// Writes all triangles, with opposite orientation for a left-handed grid. Calls place_inner(vertex, i, j, k, edges,
/// written) for every cell (i, j, k) with inner vertices: `vertex` is the first of them, inner vertex n lies amid the
/// vertices on the cell's edges edges[n], and `written` are the triangles of the cell. `place_inner` returns whether
/// one of these triangles has no area. Returns the rows of the cells that have such a triangle.
template <class ConcurrencyTag, class PlaceInner>
Grid_rows write_triangles(const Isosurface_plan& plan, Index_triangle* triangles, bool is_left_handed,
                          const PlaceInner& place_inner) {
  const std::size_t planes = plan.signs.size()[2];
  Grid_rows rows(planes);
  parallel_for<ConcurrencyTag>(0, planes - 1, [&](std::size_t k) {
    plan.has_undefined ? write_triangles_of_layer<true>(plan, k, triangles, is_left_handed, rows, place_inner)
                       : write_triangles_of_layer<false>(plan, k, triangles, is_left_handed, rows, place_inner);
  });
  return rows;
}

// A vertex of Marching Cubes is identified by its place in the grid, in whatever part of the grid it was found.

/// The place of a vertex: on the edge that begins at `node` along the axis `slot` < 3, or in the cell that begins
/// there.
struct Vertex_place {
  std::array<std::size_t, 3> node;
  std::size_t slot;
};

/// The place of inner vertex n. Inner vertices are in the order of their cells.
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

/// Gives distinct ids to the copies of a vertex, which directly follow it.
inline void distinguish_copies(std::vector<Vertex_id>& ids) {
  constexpr Vertex_id between_copies = 16; // more than the slots of a node
  for (std::size_t v = 1; v < ids.size(); ++v) {
    const Vertex_id before = ids[v - 1];
    if (before / ids_per_node == ids[v] / ids_per_node && before % between_copies == ids[v] % between_copies)
      ids[v] = before + between_copies;
  }
}

} // namespace equiaffine::internal

#endif
