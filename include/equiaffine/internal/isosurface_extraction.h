// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_ISOSURFACE_EXTRACTION_H
#define EQUIAFFINE_INTERNAL_ISOSURFACE_EXTRACTION_H

#include <equiaffine/internal/active_cells.h>
#include <equiaffine/internal/case_table.h>
#include <equiaffine/internal/node_signs.h>
#include <equiaffine/internal/parallel_for.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace equiaffine::internal {

/// The edge of a grid that begins at a node.
struct Grid_edge {
  std::array<std::size_t, 3> node;
  std::size_t axis;
};

/// Marching Cubes in passes, each of them parallel over planes or layers of cells: `count` finds the sub-case of every
/// cell, a scan gives every row of the grid its first vertex and every layer its first triangle, and `emit` makes the
/// triangles of a layer. The vertices of a row are those on its edges along i, then j, then k: the number of a vertex
/// is that of its row and kind plus the number of crossed edges before it, so no vertex is ever looked up.
///
/// `choose(i, j, k, signs)` is the sub-case of a cell that is ambiguous in the table. Memory: 16 bytes per row, 2 bytes
/// per ambiguous cell.
template <class ConcurrencyTag, class Choose>
class Isosurface_extraction {
public:
  using Word = Node_signs::Word;
  using Index = std::uint32_t;

  Isosurface_extraction(const Node_signs& signs, const Case_table& table, const Choose& choose)
      : signs_(signs), table_(table), choose_(choose), has_undefined_(signs.has_undefined()),
        rows_(signs.size()[1] * signs.size()[2] + 1), layers_(signs.size()[2]) {
    parallel_for<ConcurrencyTag>(0, layers_.size(),
                                 [&](std::size_t k) { has_undefined_ ? count<true>(k) : count<false>(k); });
    scan();
  }

  std::size_t number_of_vertices() const { return number_of_vertices_; }
  /// They come first, inner vertices of cells after them.
  std::size_t number_of_edge_vertices() const { return layers_.front().first_inner_vertex; }
  std::size_t number_of_triangles() const { return number_of_triangles_; }

  std::size_t number_of_ambiguous_cells() const {
    std::size_t sum = 0;
    for (const Layer& layer : layers_) sum += layer.sub_cases.size();
    return sum;
  }

  /// Calls place(vertex, i, j, k, axis) for every vertex on an edge; it tells whether the vertex lies at a node.
  template <class Place>
  void for_each_edge_vertex(const Place& place) {
    parallel_for<ConcurrencyTag>(
        0, layers_.size(), [&](std::size_t k) { has_undefined_ ? visit<true>(k, place) : visit<false>(k, place); });
  }

  /// Writes triangles; calls place(vertex, i, j, k, edges, triangles) for the inner vertices of cell (i, j, k), the
  /// first of them and the edges amid which each lies; it tells whether one of the cell's triangles has no area.
  template <class Place>
  void emit(std::array<Index, 3>* triangles, bool is_left_handed, const Place& place) {
    parallel_for<ConcurrencyTag>(0, layers_.size() - 1, [&](std::size_t k) {
      auto* out = triangles + layers_[k].first_triangle;
      has_undefined_ ? emit_layer<true>(k, out, is_left_handed, place)
                     : emit_layer<false>(k, out, is_left_handed, place);
    });
  }

  /// The triangles of the rows of cells around vertices for which `place` said so, ascending.
  std::vector<std::size_t> doubtful_triangles() const {
    std::vector<std::size_t> result;
    if (std::all_of(layers_.begin(), layers_.end(), [](const Layer& layer) { return layer.doubtful_rows.empty(); }))
      return result;
    const std::size_t ny = signs_.size()[1];
    std::vector<bool> is_doubtful(rows_.size());
    for (std::size_t k = 0; k < layers_.size(); ++k)
      for (const std::size_t j : layers_[k].doubtful_rows)
        for (std::size_t q = k > 0 ? k - 1 : 0; q <= k; ++q)
          for (std::size_t p = j > 0 ? j - 1 : 0; p <= j; ++p) is_doubtful[q * ny + p] = true;
    std::size_t triangle = 0;
    for (std::size_t r = 0; r + 1 < rows_.size(); ++r) {
      if (is_doubtful[r])
        for (std::size_t t = 0; t < rows_[r].triangles; ++t) result.push_back(triangle + t);
      triangle += rows_[r].triangles;
    }
    return result;
  }

  /// Calls visit(first, end) for ranges of triangles that hold all with a vertex from `vertex` on.
  template <class Visit>
  void for_each_part_with_vertices_from(std::size_t vertex, const Visit& visit) const {
    for (std::size_t k = 0; k + 1 < layers_.size(); ++k) {
      const std::size_t edge_vertices_end = rows_[(k + 2) * signs_.size()[1]].first[0];
      const std::size_t inner_vertices_end = layers_[k].inner_vertices == 0 ? 0 : layers_[k + 1].first_inner_vertex;
      if (std::max(edge_vertices_end, inner_vertices_end) > vertex)
        visit(layers_[k].first_triangle, layers_[k + 1].first_triangle);
    }
  }

  /// The edge on which a vertex lies; nothing for an inner vertex.
  std::optional<Grid_edge> edge_of(std::size_t vertex) const {
    if (vertex >= number_of_edge_vertices()) return std::nullopt;
    const auto after = std::upper_bound(rows_.begin(), rows_.end(), vertex,
                                        [](std::size_t v, const Row& r) { return v < r.first[0]; });
    const std::size_t r = std::size_t(after - rows_.begin()) - 1, j = r % signs_.size()[1], k = r / signs_.size()[1];
    const auto& first = rows_[r].first;
    const std::size_t axis = vertex >= first[2] ? 2 : vertex >= first[1] ? 1 : 0;
    std::size_t before = vertex - first[axis];
    for (std::size_t w = 0;; ++w) {
      Word crossed = signs_.crossed_edges<true>(j, k, w)[axis];
      const auto n = std::size_t(std::popcount(crossed));
      if (before >= n) {
        before -= n;
        continue;
      }
      for (; before > 0; --before) crossed &= crossed - 1;
      return Grid_edge{{64 * w + std::size_t(std::countr_zero(crossed)), j, k}, axis};
    }
  }

private:
  struct Row {
    std::array<Index, 3> first{}; // vertex on an edge along each axis; counts before the scan
    Index triangles = 0;
  };
  struct Layer {
    std::vector<std::uint16_t> sub_cases; // of the ambiguous cells
    std::vector<std::size_t> doubtful_rows;
    std::size_t first_triangle = 0, first_inner_vertex = 0, inner_vertices = 0;
  };

  Row& row(std::size_t j, std::size_t k) { return rows_[k * signs_.size()[1] + j]; }
  const Row& row(std::size_t j, std::size_t k) const { return rows_[k * signs_.size()[1] + j]; }

  template <bool HasUndefined>
  void count(std::size_t k) {
    Layer& layer = layers_[k];
    for (std::size_t j = 0; j < signs_.size()[1]; ++j) {
      Row counts;
      for (std::size_t w = 0; w < signs_.words(); ++w) {
        const auto crossed = signs_.crossed_edges<HasUndefined>(j, k, w);
        if ((crossed[0] | crossed[1] | crossed[2]) == 0) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) counts.first[axis] += Index(std::popcount(crossed[axis]));
      }
      if (j + 1 < signs_.size()[1] && k + 1 < signs_.size()[2])
        for_each_active_cell<HasUndefined>(signs_, j, k, [&](std::size_t i, unsigned signs) {
          const Case_table::Entry* entry = &table_.of_signs[signs];
          if (entry->is_ambiguous) {
            layer.sub_cases.push_back(std::uint16_t(choose_(i, j, k, signs)));
            entry = &table_.of_sub_case[layer.sub_cases.back()];
            layer.inner_vertices += entry->inner_vertices;
          }
          counts.triangles += entry->triangles;
        });
      row(j, k) = counts;
    }
  }

  void scan() {
    const std::size_t ny = signs_.size()[1];
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (r % ny == 0 && r / ny < layers_.size()) layers_[r / ny].first_triangle = number_of_triangles_;
      for (Index& first : rows_[r].first) {
        const Index n = first;
        first = Index(number_of_vertices_);
        number_of_vertices_ += n;
      }
      number_of_triangles_ += rows_[r].triangles;
    }
    for (Layer& layer : layers_) {
      layer.first_inner_vertex = number_of_vertices_;
      number_of_vertices_ += layer.inner_vertices;
    }
    CGAL_precondition(number_of_vertices_ <= std::numeric_limits<Index>::max());
  }

  template <bool HasUndefined, class Place>
  void visit(std::size_t k, const Place& place) {
    for (std::size_t j = 0; j < signs_.size()[1]; ++j) {
      auto vertex = row(j, k).first;
      if (vertex[0] == (&row(j, k))[1].first[0]) continue;
      bool is_doubtful = false;
      for (std::size_t w = 0; w < signs_.words(); ++w) {
        const auto crossed = signs_.crossed_edges<HasUndefined>(j, k, w);
        const auto visit_along = [&](auto axis) {
          for (Word bits = crossed[axis]; bits != 0; bits &= bits - 1)
            is_doubtful |= place(vertex[axis]++, 64 * w + std::size_t(std::countr_zero(bits)), j, k, axis);
        };
        visit_along(std::integral_constant<std::size_t, 0>());
        visit_along(std::integral_constant<std::size_t, 1>());
        visit_along(std::integral_constant<std::size_t, 2>());
      }
      if (is_doubtful) layers_[k].doubtful_rows.push_back(j);
    }
  }

  /// The vertices of a cell, in the slots of the table.
  using Cell_vertices = std::array<Index, 16>;

  /// Those on the edges that begin at i, by counting the edges before.
  void set_vertices(Cell_vertices& vertices, std::size_t i, std::size_t j, std::size_t k) const {
    constexpr std::size_t axes[8] = {0, 0, 0, 0, 1, 1, 2, 2}, dj[8] = {0, 1, 0, 1, 0, 0, 0, 1},
                          dk[8] = {0, 0, 1, 1, 0, 1, 0, 0};
    for (std::size_t n = 0; n < 8; ++n) {
      vertices[n] = row(j + dj[n], k + dk[n]).first[axes[n]];
      for (std::size_t w = 0; 64 * w < i; ++w)
        vertices[n] += Index(std::popcount(
            Node_signs::within(signs_.template crossed_edges<true>(j + dj[n], k + dk[n], w)[axes[n]], w, i)));
    }
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
  void emit_layer(std::size_t k, std::array<Index, 3>* out, bool is_left_handed, const Place& place) {
    const auto& cases = Marching_cubes_cases::instance();
    const std::array<Index, 3>* const end = out + (layers_[k + 1].first_triangle - layers_[k].first_triangle);
    const std::uint8_t* const slots = table_.slots[is_left_handed].data();
    const std::uint16_t* sub_case = layers_[k].sub_cases.data();
    Cell_vertices vertices{};
    const auto set_inner = [&](std::size_t first) {
      for (std::size_t n = 0; n < 3; ++n) vertices[12 + n] = Index(first + n);
    };
    set_inner(layers_[k].first_inner_vertex);
    for (std::size_t j = 0; j + 1 < signs_.size()[1]; ++j) {
      if (row(j, k).triangles == 0) continue;
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
          const std::span<const std::array<Index, 3>> triangles(out, entry->triangles);
          if (place(std::size_t(vertices[12]), i, j, k, cases[sub_case[-1]].inner_edges, triangles))
            layers_[k].doubtful_rows.push_back(j);
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
  std::vector<Row> rows_; // and one behind the last
  std::vector<Layer> layers_;
  std::size_t number_of_vertices_ = 0, number_of_triangles_ = 0;
};

} // namespace equiaffine::internal

#endif
