// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_ISOSURFACE_EXTRACTION_H
#define EQUIAFFINE_INTERNAL_ISOSURFACE_EXTRACTION_H

#include <equiaffine/internal/node_signs.h>
#include <equiaffine/internal/parallel_for.h>
#include <equiaffine/internal/trilinear_cell.h>

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

/// The sub-cases in flat arrays, for speed.
struct Flat_cases {
  static constexpr std::uint8_t ambiguous = 255;
  struct Range {
    std::uint32_t first_edge;
    std::uint8_t triangles, inner_vertices;
  };

  static const Flat_cases& instance() {
    static const Flat_cases cases;
    return cases;
  }

  Flat_cases() {
    const auto& cases = Marching_cubes_cases::instance();
    for (std::size_t s = 0; s < cases.size(); ++s) {
      ranges.push_back({std::uint32_t(edges.size()), std::uint8_t(cases[s].triangles.size()),
                        std::uint8_t(cases[s].inner_edges.size())});
      for (const auto& t : cases[s].triangles) edges.insert(edges.end(), t.begin(), t.end());
    }
    for (unsigned signs = 0; signs < 256; ++signs) {
      sub_case[signs] = cases.variant(signs, 0).sub_case;
      triangles[signs] = cases.is_ambiguous(signs) ? ambiguous : ranges[sub_case[signs]].triangles;
      const auto differ = [&](int c, int d) { return (signs >> c ^ signs >> d) & 1; };
      crossed[signs] = {differ(0, 1), differ(2, 3), differ(4, 5), differ(6, 7),
                        differ(0, 2), differ(4, 6), differ(0, 4), differ(2, 6)};
    }
  }

  std::vector<Range> ranges;                             // per sub-case
  std::vector<std::uint8_t> edges;                       // three per triangle
  std::array<std::uint16_t, 256> sub_case;               // of unambiguous signs
  std::array<std::uint8_t, 256> triangles;               // or `ambiguous`
  std::array<std::array<std::uint32_t, 8>, 256> crossed; // of the edges 0, 1, 2, 3, 4, 5, 8, 10 of the cell
};

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
/// `value(i, j, k)` is the value at a node. Memory: 20 bytes per row, 2 bytes per ambiguous cell.
template <class ConcurrencyTag, class Value>
class Isosurface_extraction {
public:
  using Word = Node_signs::Word;
  using Index = std::uint32_t;
  using FT = std::decay_t<std::invoke_result_t<const Value&, std::size_t, std::size_t, std::size_t>>;

  Isosurface_extraction(const Node_signs& signs, const Value& value, const FT& isovalue)
      : signs_(signs), value_(value), isovalue_(isovalue), has_undefined_(signs.has_undefined()),
        rows_(signs.size()[1] * signs.size()[2]), layers_(signs.size()[2]) {
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
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (is_doubtful[r])
        for (std::size_t t = 0; t < rows_[r].triangles; ++t) result.push_back(triangle + t);
      triangle += rows_[r].triangles;
    }
    return result;
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
      Word crossed = signs_.crossed_edges<true>(axis, j, k, w);
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

  /// Calls visit(i, signs) for every cell of a row that the surface meets.
  template <bool HasUndefined, class Visit>
  void for_each_cell(std::size_t j, std::size_t k, const Visit& visit) const {
    const Word* const rows[4] = {signs_.row(j, k), signs_.row(j + 1, k), signs_.row(j, k + 1),
                                 signs_.row(j + 1, k + 1)};
    for (std::size_t w = 0; w < signs_.words(); ++w) {
      Word here[8];
      const bool is_last = w + 1 == signs_.words();
      for (std::size_t r = 0; r < 4; ++r) {
        here[2 * r] = rows[r][w];
        here[2 * r + 1] = rows[r][w] >> 1 | (is_last ? 0 : rows[r][w + 1] << 63);
      }
      Word active = 0;
      for (std::size_t c = 1; c < 8; ++c) active |= here[0] ^ here[c];
      active = Node_signs::within(active, w, signs_.size()[0] - 1);
      if constexpr (HasUndefined) active &= signs_.defined_cells(j, k, w);
      for (unsigned byte = 0; active != 0; ++byte, active >>= 8) {
        Word bits = active & 0xff;
        if (bits == 0) continue;
        const Word cases = transposed(here, 8 * byte);
        for (; bits != 0; bits &= bits - 1) {
          const unsigned bit = unsigned(std::countr_zero(bits));
          visit(64 * w + 8 * byte + bit, unsigned(cases >> 8 * bit & 0xff));
        }
      }
    }
  }

  /// Byte i, bit c of the result is bit shift + i of word c (Warren, Hacker's Delight, 2012, section 7-3).
  static Word transposed(const Word (&words)[8], unsigned shift) {
    Word x = 0;
    for (unsigned c = 0; c < 8; ++c) x |= (words[c] >> shift & 0xff) << 8 * c;
    Word t = (x ^ x >> 7) & 0x00AA00AA00AA00AA;
    x ^= t ^ t << 7;
    t = (x ^ x >> 14) & 0x0000CCCC0000CCCC;
    x ^= t ^ t << 14;
    t = (x ^ x >> 28) & 0x00000000F0F0F0F0;
    return x ^ t ^ t << 28;
  }

  std::array<FT, 8> values(std::size_t i, std::size_t j, std::size_t k) const {
    std::array<FT, 8> v;
    for (std::size_t c = 0; c < 8; ++c) v[c] = value_(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
    return v;
  }

  template <bool HasUndefined>
  void count(std::size_t k) {
    const auto& flat = Flat_cases::instance();
    const auto& cases = Marching_cubes_cases::instance();
    Layer& layer = layers_[k];
    for (std::size_t j = 0; j < signs_.size()[1]; ++j) {
      Row& counts = row(j, k);
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t w = 0; w < signs_.words(); ++w)
          counts.first[axis] += Index(std::popcount(signs_.crossed_edges<HasUndefined>(axis, j, k, w)));
      if (j + 1 == signs_.size()[1] || k + 1 == signs_.size()[2]) continue;
      for_each_cell<HasUndefined>(j, k, [&](std::size_t i, unsigned signs) {
        if (flat.triangles[signs] != Flat_cases::ambiguous) {
          counts.triangles += flat.triangles[signs];
          return;
        }
        const std::size_t s = Trilinear_cell<FT>(values(i, j, k), isovalue_).sub_case(cases, signs);
        layer.sub_cases.push_back(std::uint16_t(s));
        counts.triangles += flat.ranges[s].triangles;
        layer.inner_vertices += flat.ranges[s].inner_vertices;
      });
    }
  }

  void scan() {
    const std::size_t ny = signs_.size()[1];
    for (std::size_t r = 0; r < rows_.size(); ++r) {
      if (r % ny == 0) layers_[r / ny].first_triangle = number_of_triangles_;
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
      bool is_doubtful = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::size_t vertex = row(j, k).first[axis];
        for (std::size_t w = 0; w < signs_.words(); ++w)
          for (Word crossed = signs_.crossed_edges<HasUndefined>(axis, j, k, w); crossed != 0; crossed &= crossed - 1)
            is_doubtful |= place(vertex++, 64 * w + std::size_t(std::countr_zero(crossed)), j, k, axis);
      }
      if (is_doubtful) layers_[k].doubtful_rows.push_back(j);
    }
  }

  /// The vertices on the edges 0, 1, 2, 3, 4, 5, 8, 10 of a cell, those that begin at i.
  using Cursor = std::array<Index, 8>;

  /// The cursor at cell i, by counting the edges before it.
  Cursor cursor_at(std::size_t i, std::size_t j, std::size_t k) const {
    Cursor cursor;
    constexpr std::size_t axes[8] = {0, 0, 0, 0, 1, 1, 2, 2}, dj[8] = {0, 1, 0, 1, 0, 0, 0, 1},
                          dk[8] = {0, 0, 1, 1, 0, 1, 0, 0};
    for (std::size_t n = 0; n < 8; ++n) {
      cursor[n] = row(j + dj[n], k + dk[n]).first[axes[n]];
      for (std::size_t w = 0; 64 * w < i; ++w)
        cursor[n] += Index(
            std::popcount(Node_signs::within(signs_.crossed_edges<true>(axes[n], j + dj[n], k + dk[n], w), w, i)));
    }
    return cursor;
  }

  template <bool HasUndefined, class Place>
  void emit_layer(std::size_t k, std::array<Index, 3>* out, bool is_left_handed, const Place& place) {
    const auto& flat = Flat_cases::instance();
    const auto& cases = Marching_cubes_cases::instance();
    const auto* const flat_crossed = flat.crossed.data();
    const auto* const flat_triangles = flat.triangles.data();
    const auto* const flat_sub_case = flat.sub_case.data();
    const auto* const ranges = flat.ranges.data();
    const auto* const edges = flat.edges.data();
    const std::size_t second = is_left_handed ? 2 : 1, third = 3 - second;
    const std::uint16_t* sub_case = layers_[k].sub_cases.data();
    Index inner = Index(layers_[k].first_inner_vertex);
    for (std::size_t j = 0; j + 1 < signs_.size()[1]; ++j) {
      if (row(j, k).triangles == 0) continue;
      Cursor cursor;
      if constexpr (!HasUndefined) cursor = cursor_at(0, j, k);
      for_each_cell<HasUndefined>(j, k, [&](std::size_t i, unsigned signs) {
        // Edges between two cells of this loop are in no cell without undefined nodes: only then the cursor can jump.
        if constexpr (HasUndefined) cursor = cursor_at(i, j, k);
        const auto& crossed = flat_crossed[signs];
        const Index vertices[16] = {cursor[0],
                                    cursor[1],
                                    cursor[2],
                                    cursor[3],
                                    cursor[4],
                                    cursor[5],
                                    cursor[4] + crossed[4],
                                    cursor[5] + crossed[5],
                                    cursor[6],
                                    cursor[6] + crossed[6],
                                    cursor[7],
                                    cursor[7] + crossed[7],
                                    inner,
                                    inner + 1,
                                    inner + 2,
                                    0};
        const std::size_t s = flat_triangles[signs] == Flat_cases::ambiguous ? *sub_case++ : flat_sub_case[signs];
        const Flat_cases::Range range = ranges[s];
        const std::uint8_t* edge = edges + range.first_edge;
        auto* const begin = out;
        out += range.triangles;
        for (auto* triangle = begin; triangle != out; ++triangle, edge += 3) {
          const Index a = vertices[edge[0]], b = vertices[edge[second]], c = vertices[edge[third]];
          *triangle = {a, b, c};
        }
        if (range.inner_vertices > 0) {
          const std::span<const std::array<Index, 3>> triangles(out - range.triangles, range.triangles);
          if (place(std::size_t(inner), i, j, k, cases[s].inner_edges, triangles))
            layers_[k].doubtful_rows.push_back(j);
          inner += range.inner_vertices;
        }
        for (std::size_t n = 0; n < 8; ++n) cursor[n] += crossed[n];
      });
    }
  }

  const Node_signs& signs_;
  const Value& value_;
  const FT isovalue_;
  const bool has_undefined_;
  std::vector<Row> rows_;
  std::vector<Layer> layers_;
  std::size_t number_of_vertices_ = 0, number_of_triangles_ = 0;
};

} // namespace equiaffine::internal

#endif
