// SPDX-License-Identifier: GPL-3.0-or-later
// The interface of a grid for Marching Cubes, and the numbering of the vertices and triangles of a surface in it.
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_NUMBERING_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_ISOSURFACE_NUMBERING_H

#include <equiaffine/marching_cubes/internal/node_signs.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace equiaffine::internal {

// Marching Cubes works on a `Grid`, either a Lattice_function or an Array_grid, with these members:
//
// FT, Point                       types of a number and a position
// isovalue()                      the value of the function on the surface
// cell_values({i, j, k})          the values at the corners of a cell
// edge_vertex({i, j, k}, axis)    the vertex on an edge at whose ends the values have different signs; or instead
// edges(grid_edges)               the ends of many edges and the values there
// point({i, j, k}, offset)        a position in a cell, where `offset` is in steps of the grid
// coordinates(point)              an array of three numbers
// is_left_handed()                whether the steps along i, j, k are a left-handed system
// is_nearer_to_end(edge, point)   whether a point on an edge is nearer to the end of the edge than to its beginning
// moved(point, axis, steps)       a point, moved along an axis by a fraction of a step
// index_in_whole({i, j, k})       the index of a node in the grid that this one is a part of
// is_at_cut(edge)                 whether an edge lies on a side of this grid beyond which that grid continues

/// The edge of a grid that begins at a node.
struct Grid_edge {
  std::array<std::size_t, 3> node;
  std::size_t axis;
};

/// A vertex on an edge of a grid, at the point where the linear interpolant of the values at the ends is the
/// isovalue.
template <class Point>
struct Edge_vertex {
  Point point;
  bool is_at_node;
};

/// A vertex inside a cell.
template <class FT>
struct Inner_vertex {
  std::array<std::size_t, 3> cell;
  std::array<FT, 3> offset; ///< from the first node of the cell, in steps of the grid
};

/// A set of rows of nodes along i of a grid. Threads may add rows of different planes concurrently. Repeated
/// additions of the same row are merged unless another row of its plane was added in between.
class Grid_rows {
public:
  explicit Grid_rows(std::size_t number_of_planes) : planes_(number_of_planes) {}

  void add(std::size_t j, std::size_t k) {
    auto& plane = planes_[k];
    if (plane.empty() || plane.back() != j) plane.push_back(j);
  }

  void add(const Grid_rows& other) {
    for (std::size_t k = 0; k < planes_.size(); ++k)
      planes_[k].insert(planes_[k].end(), other.planes_[k].begin(), other.planes_[k].end());
  }

  bool is_empty() const {
    return std::all_of(planes_.begin(), planes_.end(), [](const auto& plane) { return plane.empty(); });
  }

  /// Calls visit(j, k) for every row.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t k = 0; k < planes_.size(); ++k)
      for (const std::size_t j : planes_[k]) visit(j, k);
  }

private:
  std::vector<std::vector<std::size_t>> planes_; // the j of the rows in every plane
};

/// The indices of the vertices and triangles of a surface in a grid. A row of nodes has the vertices on its edges
/// along i, then j, then k, each in the order of i. The index of a vertex is that of the first one of its row and
/// axis plus the number of crossed edges before it, so that vertices never need a lookup. The vertices of a plane of
/// nodes are followed by the inner vertices of the cells above it. Triangles are in the order of their cells.
///
/// Rows and layers initially hold counts, which `turn_counts_into_numbers` replaces by indices. Memory: 16 bytes per
/// row of nodes.
class Isosurface_numbering {
public:
  using Word = Node_signs::Word;
  using Index = std::uint32_t;

  /// A row of nodes along i, and the row of cells that begins there.
  struct Row {
    std::array<Index, 3> first{}; ///< the first vertex on an edge along each axis; initially their number
    Index triangles = 0;          ///< the number of triangles in the row of cells
  };
  /// The cells between two planes of nodes.
  struct Layer {
    std::size_t first_triangle = 0, first_inner_vertex = 0, inner_vertices = 0;
    std::size_t inner_vertices_before = 0; ///< in all layers below
  };

  explicit Isosurface_numbering(const Node_signs& signs)
      : signs_(signs), rows_(signs.size()[1] * signs.size()[2] + 1), layers_(signs.size()[2]) {}

  Row& row(std::size_t j, std::size_t k) { return rows_[k * signs_.size()[1] + j]; }
  const Row& row(std::size_t j, std::size_t k) const { return rows_[k * signs_.size()[1] + j]; }
  Layer& layer(std::size_t k) { return layers_[k]; }

  void turn_counts_into_numbers() {
    const std::size_t ny = signs_.size()[1];
    for (std::size_t k = 0; k < layers_.size(); ++k) {
      Layer& layer = layers_[k];
      layer.first_triangle = number_of_triangles_;
      for (std::size_t j = 0; j < ny; ++j) {
        number_vertices(row(j, k));
        number_of_triangles_ += row(j, k).triangles;
      }
      layer.first_inner_vertex = number_of_vertices_;
      layer.inner_vertices_before = number_of_inner_vertices_;
      number_of_vertices_ += layer.inner_vertices;
      number_of_inner_vertices_ += layer.inner_vertices;
    }
    number_vertices(rows_.back());
    if (number_of_vertices_ > std::numeric_limits<Index>::max())
      throw std::length_error("a mesh has more than 2^32 vertices: compute it in slabs, or use a coarser grid");
  }

  std::size_t number_of_planes() const { return layers_.size(); }
  std::size_t number_of_vertices() const { return number_of_vertices_; }
  std::size_t number_of_inner_vertices() const { return number_of_inner_vertices_; }
  std::size_t number_of_triangles() const { return number_of_triangles_; }

  bool has_vertices(std::size_t j, std::size_t k) const {
    const Row* const r = &row(j, k);
    return r[0].first[0] != r[1].first[0];
  }
  /// The vertices on edges that begin in the planes from `first` to `end` - 1, and in the cells above these.
  Index_range vertices_of_planes(std::size_t first, std::size_t end) const {
    return {row(0, first).first[0], row(0, end).first[0]};
  }
  /// The index of an inner vertex of layer k among all inner vertices.
  std::size_t place_of_inner(std::size_t vertex, std::size_t k) const {
    return vertex - layers_[k].first_inner_vertex + layers_[k].inner_vertices_before;
  }
  Index_range inner_vertices_of_layer(std::size_t k) const {
    const Layer& layer = layers_[k];
    return {layer.first_inner_vertex, layer.first_inner_vertex + layer.inner_vertices};
  }
  Index_range triangles_of_layer(std::size_t k) const {
    return {layers_[k].first_triangle, k + 1 < layers_.size() ? layers_[k + 1].first_triangle : number_of_triangles_};
  }

  /// Calls visit(triangle) for all triangles in the rows of cells at a row of nodes.
  template <class Visit>
  void for_each_triangle_around(std::size_t j, std::size_t k, const Visit& visit) const {
    for (std::size_t q = k > 0 ? k - 1 : 0; q <= k; ++q) {
      std::size_t t = layers_[q].first_triangle;
      for (std::size_t p = 0; p <= j; ++p) {
        const std::size_t end = t + row(p, q).triangles;
        if (p + 1 >= j)
          for (std::size_t u = t; u < end; ++u) visit(u);
        t = end;
      }
    }
  }

  /// All triangles in the rows of cells at some rows of nodes, in ascending order without repetition.
  std::vector<std::size_t> triangles_around(const Grid_rows& rows) const {
    std::vector<std::size_t> result;
    if (rows.is_empty()) return result;
    const std::size_t ny = signs_.size()[1];
    std::vector<bool> is_around(rows_.size());
    rows.for_each([&](std::size_t j, std::size_t k) {
      for (std::size_t q = k > 0 ? k - 1 : 0; q <= k; ++q)
        for (std::size_t p = j > 0 ? j - 1 : 0; p <= j; ++p) is_around[q * ny + p] = true;
    });
    std::size_t t = 0;
    for (std::size_t r = 0; r < rows_.size(); t += rows_[r].triangles, ++r)
      if (is_around[r])
        for (std::size_t n = 0; n < rows_[r].triangles; ++n) result.push_back(t + n);
    return result;
  }

  /// The index among all inner vertices; nothing for a vertex on an edge.
  std::optional<std::size_t> place_of_inner(std::size_t vertex) const {
    const std::size_t k = row_of(vertex) / signs_.size()[1];
    return vertex < layers_[k].first_inner_vertex ? std::nullopt : std::optional(place_of_inner(vertex, k));
  }

  /// The edge on which a vertex lies; nothing for an inner vertex.
  std::optional<Grid_edge> edge_of(std::size_t vertex) const {
    const std::size_t r = row_of(vertex), j = r % signs_.size()[1], k = r / signs_.size()[1];
    if (vertex >= layers_[k].first_inner_vertex) return std::nullopt;
    const auto& first = rows_[r].first;
    const std::size_t axis = vertex >= first[2] ? 2 : vertex >= first[1] ? 1 : 0;
    return Grid_edge{{node_of_crossed_edge(vertex - first[axis], j, k, axis), j, k}, axis};
  }

  /// The first vertex in a row of nodes on an edge along `axis` that begins at i or later.
  Index vertex_from(std::size_t i, std::size_t j, std::size_t k, std::size_t axis) const {
    Index vertex = row(j, k).first[axis];
    const Node_signs::Edge_row<true> edges(signs_, j, k);
    for (std::size_t w = 0; 64 * w < i; ++w)
      vertex += Index(std::popcount(Node_signs::within(edges.crossed(w)[axis], w, i)));
    return vertex;
  }

private:
  void number_vertices(Row& row) {
    for (Index& first : row.first) {
      const Index count = first;
      first = Index(number_of_vertices_);
      number_of_vertices_ += count;
    }
  }

  /// The row of nodes of a vertex, or the last row before an inner vertex.
  std::size_t row_of(std::size_t vertex) const {
    const auto after = std::upper_bound(rows_.begin(), rows_.end(), vertex,
                                        [](std::size_t v, const Row& r) { return v < r.first[0]; });
    return std::size_t(after - rows_.begin()) - 1;
  }

  /// The i at which the n-th crossed edge along `axis` in a row of nodes begins; n counts from 0.
  std::size_t node_of_crossed_edge(std::size_t n, std::size_t j, std::size_t k, std::size_t axis) const {
    const Node_signs::Edge_row<true> edges(signs_, j, k);
    for (std::size_t w = 0;; ++w) {
      Word crossed = edges.crossed(w)[axis];
      const auto count = std::size_t(std::popcount(crossed));
      if (n < count) {
        for (; n > 0; --n) crossed &= crossed - 1; // removes the lowest bit
        return 64 * w + std::size_t(std::countr_zero(crossed));
      }
      n -= count;
    }
  }

  const Node_signs& signs_;
  std::vector<Row> rows_; // and one past the last
  std::vector<Layer> layers_;
  std::size_t number_of_vertices_ = 0, number_of_inner_vertices_ = 0, number_of_triangles_ = 0;
};

} // namespace equiaffine::internal

#endif
