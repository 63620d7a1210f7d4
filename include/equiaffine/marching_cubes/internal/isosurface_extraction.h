// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_EXTRACTION_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_EXTRACTION_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/marching_cubes/internal/active_cells.h>
#include <equiaffine/marching_cubes/internal/case_table.h>
#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace equiaffine::internal {

/// Marching Cubes in passes, each of them parallel over planes or layers of cells: `count` finds the sub-case of every
/// cell, a scan gives every row of the grid its first vertex and every layer its first triangle, then vertices and
/// triangles are made in any order.
///
/// `choose(i, j, k, signs)` is the sub-case of a cell that is ambiguous in the table. Memory: 2 bytes per ambiguous
/// cell.
template <class ConcurrencyTag, class Choose>
class Isosurface_extraction {
public:
  using Word = Node_signs::Word;
  using Index = Isosurface_numbering::Index;

  Isosurface_extraction(const Node_signs& signs, const Case_table& table, const Choose& choose)
      : signs_(signs), table_(table), choose_(choose), has_undefined_(signs.has_undefined()), numbering_(signs),
        sub_cases_(signs.size()[2]), doubtful_rows_(signs.size()[2]) {
    parallel_for<ConcurrencyTag>(0, signs.size()[2],
                                 [&](std::size_t k) { has_undefined_ ? count<true>(k) : count<false>(k); });
    numbering_.scan();
  }

  const Isosurface_numbering& numbering() const { return numbering_; }

  std::size_t number_of_ambiguous_cells() const {
    std::size_t sum = 0;
    for (const auto& layer : sub_cases_) sum += layer.size();
    return sum;
  }

  /// Calls place(vertex, i, j, k, axis) for every vertex on an edge that begins in plane k; it tells whether the vertex
  /// lies at a node. `axis` is a std::integral_constant.
  template <class Place>
  void for_each_vertex_of_plane(std::size_t k, const Place& place) {
    has_undefined_ ? visit<true>(k, place) : visit<false>(k, place);
  }
  template <class Place>
  void for_each_edge_vertex(const Place& place) {
    parallel_for<ConcurrencyTag>(0, signs_.size()[2], [&](std::size_t k) { for_each_vertex_of_plane(k, place); });
  }

  /// Writes triangles; calls place(vertex, i, j, k, edges, triangles) for the inner vertices of cell (i, j, k), the
  /// first of them and the edges amid which each lies; it tells whether one of the cell's triangles has no area.
  template <class Place>
  void emit(std::array<Index, 3>* triangles, bool is_left_handed, const Place& place) {
    parallel_for<ConcurrencyTag>(0, signs_.size()[2] - 1, [&](std::size_t k) {
      has_undefined_ ? emit_layer<true>(k, triangles, is_left_handed, place)
                     : emit_layer<false>(k, triangles, is_left_handed, place);
    });
  }

  /// The triangles of the rows of cells around vertices for which `place` said so, ascending.
  std::vector<std::size_t> doubtful_triangles() const { return numbering_.triangles_around(doubtful_rows_); }

private:
  template <bool HasUndefined>
  void count(std::size_t k) {
    auto& sub_cases = sub_cases_[k];
    auto& layer = numbering_.layer(k);
    for (std::size_t j = 0; j < signs_.size()[1]; ++j) {
      Isosurface_numbering::Row counts;
      const Node_signs::Edge_row<HasUndefined> edges(signs_, j, k);
      signs_.for_each_word(j, k, [&](std::size_t w) {
        const auto crossed = edges.crossed(w);
        if ((crossed[0] | crossed[1] | crossed[2]) == 0) return;
        for (std::size_t axis = 0; axis < 3; ++axis) counts.first[axis] += Index(std::popcount(crossed[axis]));
      });
      if (j + 1 < signs_.size()[1] && k + 1 < signs_.size()[2])
        for_each_active_cell<HasUndefined>(signs_, j, k, [&](std::size_t i, unsigned signs) {
          const Case_table::Entry* entry = &table_.of_signs[signs];
          if (entry->is_ambiguous) {
            sub_cases.push_back(std::uint16_t(choose_(i, j, k, signs)));
            entry = &table_.of_sub_case[sub_cases.back()];
            layer.inner_vertices += entry->inner_vertices;
          }
          counts.triangles += entry->triangles;
        });
      numbering_.row(j, k) = counts;
    }
  }

  template <bool HasUndefined, class Place>
  void visit(std::size_t k, const Place& place) {
    for (std::size_t j = 0; j < signs_.size()[1]; ++j) {
      if (!numbering_.has_vertices(j, k)) continue;
      auto vertex = numbering_.row(j, k).first;
      bool is_doubtful = false;
      const Node_signs::Edge_row<HasUndefined> edges(signs_, j, k);
      signs_.for_each_word(j, k, [&](std::size_t w) {
        const auto crossed = edges.crossed(w);
        const auto visit_along = [&](auto axis) {
          for (Word bits = crossed[axis]; bits != 0; bits &= bits - 1)
            is_doubtful |= place(vertex[axis]++, 64 * w + std::size_t(std::countr_zero(bits)), j, k, axis);
        };
        if ((crossed[0] | crossed[1] | crossed[2]) == 0) return;
        visit_along(std::integral_constant<std::size_t, 0>());
        visit_along(std::integral_constant<std::size_t, 1>());
        visit_along(std::integral_constant<std::size_t, 2>());
      });
      if (is_doubtful) doubtful_rows_[k].push_back(j);
    }
  }

  /// The vertices of a cell, in the slots of the table.
  using Cell_vertices = std::array<Index, 16>;

  /// Those on the edges that begin at i.
  void set_vertices(Cell_vertices& vertices, std::size_t i, std::size_t j, std::size_t k) const {
    constexpr std::size_t axes[8] = {0, 0, 0, 0, 1, 1, 2, 2}, dj[8] = {0, 1, 0, 1, 0, 0, 0, 1},
                          dk[8] = {0, 0, 1, 1, 0, 1, 0, 0};
    for (std::size_t n = 0; n < 8; ++n) vertices[n] = numbering_.vertex_from(i, j + dj[n], k + dk[n], axes[n]);
  }

  /// Writes the triangles of a cell. As many as most cells have are written without asking how many there are, where
  /// there is room: a wrong guess of the processor costs more than what is overwritten afterwards.
  static void write(const Cell_vertices& vertices, const std::uint8_t* slot, std::size_t n, std::array<Index, 3>* out,
                    const std::array<Index, 3>* end) {
    std::size_t t = 0;
    const auto write_one = [&] {
      out[t] = {vertices[slot[3 * t]], vertices[slot[3 * t + 1]], vertices[slot[3 * t + 2]]};
      ++t;
    };
    if (std::size_t(end - out) >= Case_table::at_once)
      while (t < Case_table::at_once) write_one();
    while (t < n) write_one();
  }

  template <bool HasUndefined, class Place>
  void emit_layer(std::size_t k, std::array<Index, 3>* triangles, bool is_left_handed, const Place& place) {
    const auto& cases = Marching_cubes_cases::instance();
    const Index_range range = numbering_.triangles_of_layer(k);
    auto* out = triangles + range.first;
    const auto* const end = triangles + range.end;
    const std::uint8_t* const slots = table_.slots[is_left_handed].data();
    const std::uint16_t* sub_case = sub_cases_[k].data();
    Cell_vertices vertices{};
    const auto set_inner = [&](std::size_t first) {
      for (std::size_t n = 0; n < 3; ++n) vertices[12 + n] = Index(first + n);
    };
    set_inner(numbering_.inner_vertices_of_layer(k).first);
    for (std::size_t j = 0; j + 1 < signs_.size()[1]; ++j) {
      if (numbering_.row(j, k).triangles == 0) continue;
      if constexpr (!HasUndefined) set_vertices(vertices, 0, j, k);
      for_each_active_cell<HasUndefined>(signs_, j, k, [&](std::size_t i, unsigned signs) {
        // Edges between two cells of this loop are in no cell without undefined nodes: only then i can jump.
        if constexpr (HasUndefined) set_vertices(vertices, i, j, k);
        const auto& crossed = table_.crossed[signs];
        for (std::size_t n = 4; n < 8; ++n) vertices[n + 4] = vertices[n] + crossed[n];
        const Case_table::Entry* entry = &table_.of_signs[signs];
        if (entry->is_ambiguous) entry = &table_.of_sub_case[*sub_case++];
        write(vertices, slots + entry->first_slot, entry->triangles, out, end);
        if (entry->inner_vertices > 0) {
          const std::span<const std::array<Index, 3>> written(out, entry->triangles);
          if (place(std::size_t(vertices[12]), i, j, k, cases[sub_case[-1]].inner_edges, written))
            doubtful_rows_[k].push_back(j);
          set_inner(vertices[12] + entry->inner_vertices);
        }
        out += entry->triangles;
        for (std::size_t n = 0; n < 4; ++n) vertices[n] += crossed[n];
        for (std::size_t n = 4; n < 8; ++n) vertices[n] = vertices[n + 4];
      });
    }
  }

  const Node_signs& signs_;
  const Case_table& table_;
  const Choose& choose_;
  const bool has_undefined_;
  Isosurface_numbering numbering_;
  std::vector<std::vector<std::uint16_t>> sub_cases_;   // of the ambiguous cells of every layer
  std::vector<std::vector<std::size_t>> doubtful_rows_; // of every plane
};

} // namespace equiaffine::internal

#endif
