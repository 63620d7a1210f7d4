// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_VERTEX_PROJECTION_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_VERTEX_PROJECTION_H

#include <equiaffine/capabilities.h>
#include <equiaffine/function/internal/shared/sign_change.h>
#include <equiaffine/marching_cubes/internal/grid/lattice_function.h>
#include <equiaffine/marching_cubes/internal/isosurface_extraction.h>
#include <equiaffine/marching_cubes/internal/vertex/intersect_edges.h>
#include <equiaffine/marching_cubes/internal/vertex/zero_area_repair.h>
#include <equiaffine/surface/Isosurface_3.h>

#include <CGAL/Kernel/global_functions_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

struct Projection_report {
  std::size_t evaluations;        ///< the number of evaluations of the function
  std::size_t flips_undone;       ///< vertices that were put back
  Grid_rows suspects;             ///< rows of nodes with a vertex, around which triangles may have no area
  std::vector<std::size_t> poles; ///< vertices on edges along which the function has a pole, or an end, and no zero
};

/// Moves the vertices of a mesh from their linear positions, where the linear interpolant along an edge of the lattice
/// vanishes, onto the surface of the function. If that takes away the area of a triangle or turns the triangle over,
/// its vertices are moved back.
///
/// Slabs of planes are projected one after the other, so that only the linear positions of one slab are kept in memory.
/// Vertices that are moved back may turn other triangles over. These are few, and the linear positions of their
/// vertices are computed again.
template <class ConcurrencyTag, class Traits>
class Vertex_projection {
  using FT = typename Traits::FT;
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using Function = Lattice_function<Traits>;
  using Triangle = std::array<std::uint32_t, 3>;
  static constexpr std::size_t slab = 32; // the number of planes in a slab

public:
  Vertex_projection(const Function& function, const Isosurface_plan& plan,
                    const std::vector<Inner_vertex<FT>>& inner_vertices, Isosurface_3<Kernel>& surface)
      : function_(function), plan_(plan), numbering_(plan.numbering), inner_vertices_(inner_vertices),
        surface_(surface), evaluations_(numbering_.number_of_planes()), flipped_(numbering_.number_of_planes()),
        poles_(numbering_.number_of_planes()), suspects_(numbering_.number_of_planes()) {}

  Projection_report run() {
    const std::size_t planes = numbering_.number_of_planes();
    Positions linear;
    for (std::size_t k = 0; k < planes; k += slab) {
      const std::size_t end = std::min(k + slab, planes);
      linear = linear_positions(k, end, linear);
      for_each_plane(k, end, [&](std::size_t plane) { project(plane); });
      for_each_plane(k > 0 ? k - 1 : 0, end - 1, [&](std::size_t layer) { find_flipped(layer, linear); });
    }
    undo_flips();
    return {std::accumulate(evaluations_.begin(), evaluations_.end(), std::size_t(0)), flips_undone_,
            std::move(suspects_), joined(poles_)};
  }

private:
  /// The positions of vertices with successive numbers.
  struct Positions {
    std::size_t first = 0;
    std::vector<Point_3> points;
    const Point_3& operator[](std::size_t v) const { return points[v - first]; }
  };

  template <class Visit>
  static void for_each_plane(std::size_t first, std::size_t end, const Visit& visit) {
    parallel_for<ConcurrencyTag>(first, end, visit);
  }

  /// The linear positions of the vertices on edges that begin in the planes `first` to `end` - 1, which are not yet
  /// projected, and in the plane below them, which is projected already: its linear positions are in `below`.
  Positions linear_positions(std::size_t first, std::size_t end, const Positions& below) const {
    const auto vertices = [&](std::size_t k) { return numbering_.vertices_of_plane(k); };
    const std::size_t first_kept = vertices(first > 0 ? first - 1 : 0).first;
    Positions linear{first_kept, {}};
    if (first > 0) linear.points.assign(&below[first_kept], &below[first_kept] + (vertices(first).first - first_kept));
    linear.points.insert(linear.points.end(), surface_.points.begin() + std::ptrdiff_t(vertices(first).first),
                         surface_.points.begin() + std::ptrdiff_t(vertices(end - 1).end));
    return linear;
  }

  /// Projects the vertices on the edges that begin in plane k and those in the cells above it.
  void project(std::size_t k) {
    for_each_batch_of_plane(plan_, k,
                            [&](std::span<const std::size_t> vertices, std::span<const Grid_edge> grid_edges) {
                              const auto edges = function_.edges(grid_edges);
                              evaluations_[k] += Function::evaluations(2 * edges.size());
                              const auto projected = intersect_edges<Traits>(function_.traits(), edges);
                              for (std::size_t n = 0; n < vertices.size(); ++n) {
                                set_projected(vertices[n], k, projected[n]);
                                if (edges[n].ends_at(surface_.points[vertices[n]]))
                                  suspects_.add(grid_edges[n].node[1], k);
                              }
                            });
    const Index_range inner = numbering_.inner_vertices_of_layer(k);
    for (std::size_t v = inner.first; v < inner.end; ++v) set_projected(v, k, project_within_cell(inner_vertex(v)));
  }

  void set_projected(std::size_t v, std::size_t k, const Surface_point_3<Kernel>& projected) {
    if (projected.has_converged) surface_.points[v] = projected.point;
    else surface_.vertex_status[v] = Point_status::UNCONVERGED;
    if (projected.is_at_pole || projected.is_at_end) poles_[k].push_back(v);
    evaluations_[k] += projected.evaluations;
  }

  /// Finds a zero of the function near a vertex inside a cell. It is looked for along each axis, between the vertex and
  /// a wall a little within the cell, so that the vertex stays inside.
  Surface_point_3<Kernel> project_within_cell(const Inner_vertex<FT>& vertex) const {
    const auto& traits = function_.traits();
    const Point_3 p = point_of(vertex);
    Surface_point_3<Kernel> best{p, false, 1};
    FT best_distance(1); // in squared steps of the lattice
    const FT value = traits.value(p);
    if (value == FT(0)) return {p, true, 1};
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const FT& wall : {FT(0.0625), FT(0.9375)}) {
        auto end = vertex.offset;
        end[axis] = wall;
        const Point_3 q = function_.point(vertex.cell, end);
        const FT end_value = traits.value(q);
        ++best.evaluations;
        if (!is_sign_change(value, end_value) || p == q) continue;
        const auto found = intersect_segment(traits, p, q, value, end_value);
        best.evaluations += found.evaluations;
        const FT distance = (found.point - p).squared_length() / function_.lattice().steps()[axis].squared_length();
        if (!found.has_converged || !(distance < best_distance)) continue;
        best.point = found.point;
        best.has_converged = true;
        best_distance = distance;
      }
    return best;
  }

  /// Finds the triangles of layer k that projection has turned over.
  void find_flipped(std::size_t k, const Positions& linear) {
    const auto linear_position = [&](std::size_t v) { return is_inner(v) ? point_of(inner_vertex(v)) : linear[v]; };
    const Index_range triangles = numbering_.triangles_of_layer(k);
    for (std::size_t t = triangles.first; t < triangles.end; ++t)
      if (is_flipped(t, linear_position)) flipped_[k].push_back(t);
  }

  /// Whether projection has turned a triangle over or taken away its area. This is decided in lattice coordinates, so
  /// that the image of a surface under an affine map has the images of its vertices.
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

  /// Whether the area of a triangle is greater than the rounding of its coordinates could make it, so that the
  /// direction of its normal means something.
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

  /// Puts back the vertices of flipped triangles, and of those that are flipped once other vertices are back.
  void undo_flips() {
    std::vector<std::size_t> suspects = joined(flipped_);
    for (std::size_t n = 0; n < suspects.size(); ++n) {
      const std::size_t t = suspects[n];
      if (!is_flipped_now(t)) continue;
      const Triangle triangle = surface_.triangles[t];
      if (!has_side({linear_position(triangle[0]), linear_position(triangle[1]), linear_position(triangle[2])})) {
        // Beside a node whose value is almost zero, two vertices are equal up to rounding, and projection may have made
        // them exactly equal. Once these two are put back, the third one may stay where it is.
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

  /// Computes the linear position of a vertex again.
  Point_3 linear_position(std::size_t v) {
    if (is_inner(v)) return point_of(inner_vertex(v));
    evaluations_[0] += Function::evaluations(2);
    return function_.edge(*numbering_.edge_of(v)).linear_intersection();
  }

  /// Puts back the vertices that projection has moved by no more than rounding.
  void undo_roundings(const Triangle& triangle) {
    for (const std::size_t v : triangle) {
      const Point_3 position = linear_position(v);
      if ((surface_.points[v] - position).squared_length() <= squared_rounding(position)) surface_.points[v] = position;
    }
  }

  /// Puts a vertex back to its linear position. Returns whether it was elsewhere.
  bool put_back(std::size_t v) {
    const Point_3 position = linear_position(v);
    if (surface_.points[v] == position) return false;
    surface_.points[v] = position;
    surface_.vertex_status[v] = Point_status::UNCONVERGED;
    ++flips_undone_;
    return true;
  }

  /// Appends the numbers of the triangles that have v as a vertex.
  void append_triangles_around(std::size_t v, std::vector<std::size_t>& triangles) const {
    const auto node = is_inner(v) ? inner_vertex(v).cell : numbering_.edge_of(v)->node;
    numbering_.for_each_triangle_around(node[1], node[2], [&](std::size_t t) {
      const Triangle& triangle = surface_.triangles[t];
      if (std::find(triangle.begin(), triangle.end(), v) != triangle.end()) triangles.push_back(t);
    });
  }

  static std::vector<std::size_t> joined(const std::vector<std::vector<std::size_t>>& parts) {
    std::vector<std::size_t> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  bool is_inner(std::size_t v) const { return v >= numbering_.number_of_edge_vertices(); }
  const Inner_vertex<FT>& inner_vertex(std::size_t v) const {
    return inner_vertices_[v - numbering_.number_of_edge_vertices()];
  }
  Point_3 point_of(const Inner_vertex<FT>& vertex) const { return function_.point(vertex.cell, vertex.offset); }

  const Function& function_;
  const Isosurface_plan& plan_;
  const Isosurface_numbering& numbering_;
  const std::vector<Inner_vertex<FT>>& inner_vertices_;
  Isosurface_3<Kernel>& surface_;
  std::vector<std::size_t> evaluations_;          // per plane
  std::vector<std::vector<std::size_t>> flipped_; // triangles per layer
  std::vector<std::vector<std::size_t>> poles_;   // vertices per plane
  Grid_rows suspects_;
  std::size_t flips_undone_ = 0;
};

/// Projects the vertices of `surface`, which are at their linear positions: changes its points and their status.
template <class ConcurrencyTag, class Traits>
Projection_report project_vertices(const Lattice_function<Traits>& function, const Isosurface_plan& plan,
                                   const std::vector<Inner_vertex<typename Traits::FT>>& inner_vertices,
                                   Isosurface_3<Kernel_of<Traits>>& surface) {
  return Vertex_projection<ConcurrencyTag, Traits>(function, plan, inner_vertices, surface).run();
}

} // namespace equiaffine::internal

#endif
