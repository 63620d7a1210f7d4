// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_PROJECTION_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_PROJECTION_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/function/internal/intersect_segments.h>
#include <equiaffine/function/internal/point_blocks.h>
#include <equiaffine/marching_cubes/internal/isosurface_extraction.h>
#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/internal/zero_area_repair.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/surface/project_to_surface.h>
#include <equiaffine/volume/Cell_block.h>

#include <CGAL/Kernel/global_functions_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Finds a zero of the function near a vertex inside a cell. Searches along each axis between the vertex and a wall
/// slightly inside the cell, so that the vertex stays in the cell.
template <class Traits>
Surface_point_3<Kernel_of<Traits>> project_within_cell(const Lattice_function<Traits>& function,
                                                       const Inner_vertex<typename Traits::FT>& vertex) {
  using FT = typename Traits::FT;
  using Point_3 = typename Traits::Point_3;
  const auto& traits = function.traits();
  const Point_3 p = function.point(vertex.cell, vertex.offset);
  Surface_point_3<Kernel_of<Traits>> best{p, false, 1};
  FT best_distance(1); // in squared steps of the lattice
  const FT value = traits.value(p);
  if (value == FT(0)) return {p, true, 1};
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const FT& wall : {FT(0.0625), FT(0.9375)}) {
      auto end = vertex.offset;
      end[axis] = wall;
      const Point_3 q = function.point(vertex.cell, end);
      const FT end_value = traits.value(q);
      ++best.evaluations;
      if (!is_sign_change(value, end_value) || p == q) continue;
      const auto found = intersect_segment(traits, p, q, value, end_value);
      best.evaluations += found.evaluations;
      const FT distance = (found.point - p).squared_length() / function.lattice().steps()[axis].squared_length();
      if (!found.has_converged || !(distance < best_distance)) continue;
      best.point = found.point;
      best.has_converged = true;
      best_distance = distance;
    }
  return best;
}

/// Finds a zero of a spline on an edge at whose ends the samples have different signs. If the spline does not have
/// different signs there, the zero is searched for nearby.
template <class Traits>
Surface_point_3<Kernel_of<Traits>> intersect_edge_of_samples(const Traits& traits,
                                                             const typename Lattice_function<Traits>::Edge& edge) {
  using FT = typename Traits::FT;
  using std::sqrt;
  const auto& [a, b] = edge.ends;
  const FT fa = traits.value(a), fb = traits.value(b);
  auto result = is_sign_change(fa, fb)
                    ? intersect_segment(traits, a, b, fa, fb)
                    : project_to_surface(traits, edge.linear_intersection(), FT(sqrt((b - a).squared_length())));
  result.evaluations += 2;
  return result;
}

/// Finds a zero of f on each edge of a lattice.
template <class Traits>
std::vector<Surface_point_3<Kernel_of<Traits>>>
intersect_edges(const Batch_function_traits_3<Traits>& traits,
                std::span<const typename Lattice_function<Traits>::Edge> edges) {
  if constexpr (Lattice_function<Traits>::has_samples) {
    std::vector<Surface_point_3<Kernel_of<Traits>>> results;
    results.reserve(edges.size());
    for (const auto& edge : edges) results.push_back(intersect_edge_of_samples<Traits>(traits, edge));
    return results;
  } else {
    return intersect_segments(traits, edges);
  }
}

// The blocks of nodes whose vertices a thread projects, one at a time.

/// The number of planes whose vertices are projected together; larger if there are few tiles, to keep the threads
/// busy.
template <class Traits>
std::size_t planes_of_slab(const Node_signs::Size& size) {
  constexpr std::size_t planes = cells_of_tile[2], enough_tiles = 64;
  if constexpr (!CellwiseImplicitFunctionTraits_3<Traits>) return planes;
  const std::size_t tiles = ((size[0] - 1) / cells_of_tile[0] + 1) * ((size[1] - 1) / cells_of_tile[1] + 1);
  return planes * std::max<std::size_t>(1, enough_tiles / tiles);
}

/// The blocks of nodes of some planes: tiles for a function that can be restricted to cells, otherwise planes.
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
    const Index_range numbers = plan.numbering.inner_vertices_of_layer(k); // in the order of their cells
    const auto of_layer =
        std::span(inner_vertices).subspan(plan.numbering.place_of_inner(numbers.first, k), numbers.size());
    auto vertex = std::partition_point(of_layer.begin(), of_layer.end(),
                                       [&](const auto& inner) { return inner.cell[1] < block[1].first; });
    for (; vertex != of_layer.end() && vertex->cell[1] < block[1].end; ++vertex)
      if (block[0].first <= vertex->cell[0] && vertex->cell[0] < block[0].end)
        visit(numbers.first + std::size_t(vertex - of_layer.begin()), *vertex);
  }
}

/// The cells around the vertices at the nodes of a block; nothing if it has no vertices. Includes neighbors, because
/// rounding may move a vertex to another cell at its edge or beyond an end of the edge.
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

struct Projection_report {
  std::size_t evaluations;        ///< the number of evaluations of the function
  std::size_t flips_undone;       ///< the number of vertices that were moved back
  Grid_rows suspects;             ///< rows with a vertex at a node, around which triangles may have no area
  std::vector<std::size_t> poles; ///< vertices on edges on which the function has a pole or an end but no zero
};

/// Moves the vertices of a mesh from their linear positions, the zeros of the linear interpolants along the edges of
/// the lattice, onto the surface of the function. If this flips a triangle or removes its area, its vertices are
/// moved back.
///
/// Slabs of planes are projected one at a time, so that only the linear positions of one slab are kept in memory. A
/// function that can be restricted to cells is evaluated in one tile of its lattice at a time. Moving vertices back
/// may flip other triangles. There are few of these, and the linear positions of their vertices are recomputed.
template <class ConcurrencyTag, class Traits>
class Vertex_projection {
  using FT = typename Traits::FT;
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using Function = Lattice_function<Traits>;
  using Triangle = std::array<std::uint32_t, 3>;

public:
  Vertex_projection(const Function& function, const Isosurface_plan& plan,
                    const std::vector<Inner_vertex<FT>>& inner_vertices, Isosurface_3<Kernel>& surface)
      : function_(function), plan_(plan), numbering_(plan.numbering), inner_vertices_(inner_vertices),
        surface_(surface), flipped_(numbering_.number_of_planes()), suspects_(numbering_.number_of_planes()) {}

  Projection_report run() {
    const std::size_t planes = numbering_.number_of_planes(), slab = planes_of_slab<Traits>(plan_.signs.size());
    Positions linear;
    for (std::size_t k = 0; k < planes; k += slab) {
      const std::size_t end = std::min(k + slab, planes);
      linear = linear_positions(k, end, linear);
      project_slab(k, end);
      parallel_for<ConcurrencyTag>(k > 0 ? k - 1 : 0, end - 1, [&](std::size_t layer) { find_flipped(layer, linear); });
    }
    undo_flips();
    return {evaluations_, flips_undone_, std::move(suspects_), std::move(poles_)};
  }

private:
  /// The positions of vertices with consecutive indices.
  struct Positions {
    std::size_t first = 0;
    std::vector<Point_3> points;
    const Point_3& operator[](std::size_t v) const { return points[v - first]; }
  };

  /// The results of a thread for the vertices at the nodes of a block.
  struct Part {
    std::size_t evaluations = 0;
    std::vector<std::size_t> poles;
    std::vector<std::array<std::size_t, 2>> suspects; ///< j, k of rows of nodes
  };

  /// The linear positions of the vertices on edges that begin in the planes `first` to `end` - 1 and in the cells
  /// above, which are not yet projected, and in the plane below. That plane is already projected; its linear
  /// positions are in `below`.
  Positions linear_positions(std::size_t first, std::size_t end, const Positions& below) const {
    const Index_range vertices = numbering_.vertices_of_planes(first, end);
    const std::size_t first_kept = numbering_.vertices_of_planes(first > 0 ? first - 1 : 0, end).first;
    Positions linear{first_kept, {}};
    if (first > 0) {
      const auto kept = below.points.begin() + std::ptrdiff_t(first_kept - below.first);
      linear.points.assign(kept, kept + std::ptrdiff_t(vertices.first - first_kept));
    }
    linear.points.insert(linear.points.end(), surface_.points.begin() + std::ptrdiff_t(vertices.first),
                         surface_.points.begin() + std::ptrdiff_t(vertices.end));
    return linear;
  }

  /// Projects the vertices on the edges that begin in the planes `first` to `end` - 1, and those in the cells above.
  void project_slab(std::size_t first, std::size_t end) {
    const std::vector<Node_block> blocks = blocks_of_slab<Traits>(plan_, {first, end});
    std::vector<Part> parts(blocks.size());
    parallel_for<ConcurrencyTag>(0, blocks.size(), [&](std::size_t n) {
      if constexpr (CellwiseImplicitFunctionTraits_3<Traits>) {
        if (const auto cells = cells_with_vertices(plan_, inner_vertices_, blocks[n]))
          project(function_.restricted_to_cells(*cells), blocks[n], parts[n]);
      } else {
        project(function_, blocks[n], parts[n]);
      }
    });
    for (const Part& part : parts) {
      evaluations_ += part.evaluations;
      poles_.insert(poles_.end(), part.poles.begin(), part.poles.end());
      for (const auto& [j, k] : part.suspects) suspects_.add(j, k);
    }
  }

  /// Projects the vertices on the edges that begin at nodes of a block, and those in the cells that begin there.
  void project(const Function& function, const Node_block& block, Part& part) {
    for_each_batch(plan_, block, [&](std::span<const std::size_t> vertices, std::span<const Grid_edge> grid_edges) {
      const auto edges = function.edges(grid_edges);
      part.evaluations += Function::evaluations(2 * edges.size());
      const auto projected = intersect_edges<Traits>(function.traits(), edges);
      for (std::size_t n = 0; n < vertices.size(); ++n) {
        set_projected(vertices[n], projected[n], part);
        if (edges[n].ends_at(surface_.points[vertices[n]]))
          part.suspects.push_back({grid_edges[n].node[1], grid_edges[n].node[2]});
      }
    });
    for_each_inner_vertex(plan_, inner_vertices_, block, [&](std::size_t v, const Inner_vertex<FT>& inner) {
      set_projected(v, project_within_cell<Traits>(function, inner), part);
    });
  }

  void set_projected(std::size_t v, const Surface_point_3<Kernel>& projected, Part& part) {
    if (projected.has_converged) surface_.points[v] = projected.point;
    else surface_.vertex_status[v] = Point_status::UNCONVERGED;
    if (projected.is_at_pole || projected.is_at_end) part.poles.push_back(v);
    part.evaluations += projected.evaluations;
  }

  /// Finds the triangles of layer k that projection has flipped.
  void find_flipped(std::size_t k, const Positions& linear) {
    const Index_range triangles = numbering_.triangles_of_layer(k);
    for (std::size_t t = triangles.first; t < triangles.end; ++t)
      if (is_flipped(t, [&](std::size_t v) { return linear[v]; })) flipped_[k].push_back(t);
  }

  /// Whether projection has flipped a triangle or removed its area. Decided in lattice coordinates, so that the
  /// result is invariant under affine maps.
  template <class LinearPosition>
  bool is_flipped(std::size_t t, const LinearPosition& linear_position) const {
    const auto& steps = function_.lattice().steps();
    const auto normal = [&](const auto& p) {
      const auto n = CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
      return Vector_3(n * steps[0], n * steps[1], n * steps[2]);
    };
    std::array<Point_3, 3> points, linear;
    for (std::size_t m = 0; m < 3; ++m) {
      points[m] = surface_.points[surface_.triangles[t][m]];
      linear[m] = linear_position(surface_.triangles[t][m]);
    }
    const FT cosine = normal(points) * normal(linear);
    if (cosine > FT(0)) return false;
    return (cosine < FT(0) && has_side(linear)) || (have_no_area(points) && !have_no_area(linear));
  }

  /// Whether the area of a triangle exceeds the effect of rounding its coordinates, so that its normal is meaningful.
  static bool has_side(const std::array<Point_3, 3>& p) {
    const Vector_3 u = p[1] - p[0], v = p[2] - p[0];
    const FT length = std::max(u.squared_length(), v.squared_length());
    return CGAL::cross_product(u, v).squared_length() > squared_rounding(p[0]) * length;
  }

  static FT squared_rounding(const Point_3& p) {
    const FT rounding = FT(16) * std::numeric_limits<FT>::epsilon();
    return rounding * rounding * (p - CGAL::ORIGIN).squared_length();
  }

  static bool have_no_area(const std::array<Point_3, 3>& p) {
    return has_zero_area(Function::coordinates(p[0]), Function::coordinates(p[1]), Function::coordinates(p[2]));
  }

  /// Moves back the vertices of flipped triangles, and of those that are flipped by moving other vertices back.
  void undo_flips() {
    std::vector<std::size_t> suspects;
    for (const auto& of_layer : flipped_) suspects.insert(suspects.end(), of_layer.begin(), of_layer.end());
    for (std::size_t n = 0; n < suspects.size(); ++n) {
      const std::size_t t = suspects[n];
      if (!is_flipped_now(t)) continue;
      const Triangle triangle = surface_.triangles[t];
      if (!has_side({linear_position(triangle[0]), linear_position(triangle[1]), linear_position(triangle[2])})) {
        // Near a node with a value of almost zero, two vertices are equal up to rounding, and projection may have
        // made
        // them exactly equal. Once these two are moved back, the third one may stay.
        undo_roundings(triangle);
        if (!is_flipped_now(t)) continue;
      }
      for (const std::size_t v : triangle)
        if (put_back(v)) append_triangles_around(v, suspects);
    }
  }

  bool is_flipped_now(std::size_t t) {
    return is_flipped(t, [&](std::size_t v) { return linear_position(v); });
  }

  /// Recomputes the linear position of a vertex.
  Point_3 linear_position(std::size_t v) {
    if (const auto inner = numbering_.place_of_inner(v)) return point_of(inner_vertices_[*inner]);
    evaluations_ += Function::evaluations(2);
    return function_.edge(*numbering_.edge_of(v)).linear_intersection();
  }

  /// Moves back the vertices that projection has moved by no more than rounding.
  void undo_roundings(const Triangle& triangle) {
    for (const std::size_t v : triangle) {
      const Point_3 position = linear_position(v);
      if ((surface_.points[v] - position).squared_length() <= squared_rounding(position)) surface_.points[v] = position;
    }
  }

  /// Moves a vertex back to its linear position. Returns false if it was already there.
  bool put_back(std::size_t v) {
    const Point_3 position = linear_position(v);
    if (surface_.points[v] == position) return false;
    surface_.points[v] = position;
    surface_.vertex_status[v] = Point_status::UNCONVERGED;
    ++flips_undone_;
    return true;
  }

  /// Appends the triangles that have v as a vertex.
  void append_triangles_around(std::size_t v, std::vector<std::size_t>& triangles) const {
    const auto edge = numbering_.edge_of(v);
    const auto node = edge ? edge->node : inner_vertices_[*numbering_.place_of_inner(v)].cell;
    numbering_.for_each_triangle_around(node[1], node[2], [&](std::size_t t) {
      const Triangle& triangle = surface_.triangles[t];
      if (std::find(triangle.begin(), triangle.end(), v) != triangle.end()) triangles.push_back(t);
    });
  }

  Point_3 point_of(const Inner_vertex<FT>& vertex) const { return function_.point(vertex.cell, vertex.offset); }

  const Function& function_;
  const Isosurface_plan& plan_;
  const Isosurface_numbering& numbering_;
  const std::vector<Inner_vertex<FT>>& inner_vertices_;
  Isosurface_3<Kernel>& surface_;
  std::size_t evaluations_ = 0;
  std::vector<std::vector<std::size_t>> flipped_; // triangles per layer
  std::vector<std::size_t> poles_;                // vertices
  Grid_rows suspects_;
  std::size_t flips_undone_ = 0;
};

/// Projects the vertices of `surface` from their linear positions; changes its points and their status.
template <class ConcurrencyTag, class Traits>
Projection_report project_vertices(const Lattice_function<Traits>& function, const Isosurface_plan& plan,
                                   const std::vector<Inner_vertex<typename Traits::FT>>& inner_vertices,
                                   Isosurface_3<Kernel_of<Traits>>& surface) {
  return Vertex_projection<ConcurrencyTag, Traits>(function, plan, inner_vertices, surface).run();
}

} // namespace equiaffine::internal

#endif
