// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_PROJECTION_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_PROJECTION_H

#include <equiaffine/marching_cubes/internal/isosurface_extraction.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/internal/zero_area_repair.h>
#include <equiaffine/surface/Isosurface_3.h>
#include <equiaffine/surface/project_to_surface.h>
#include <equiaffine/surface/sign_change.h>

#include <CGAL/Kernel/global_functions_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

namespace equiaffine::internal {

/// A vertex inside a cell.
template <class FT>
struct Inner_vertex {
  std::array<std::size_t, 3> cell;
  std::array<FT, 3> offset;
};

/// Puts the vertices of a mesh from the linear intersections on the surface of the function. Where that takes away the
/// area of a triangle or turns it over, away from the side to which its linear version looks, its vertices go back.
///
/// Slabs of planes one after the other, so that linear positions are kept for one slab only. What goes back may turn
/// other triangles over; they are few, and their linear positions are computed again.
template <class ConcurrencyTag, class Traits, class Extraction>
class Vertex_projection {
  using FT = typename Traits::FT;
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Vector_3 = typename Traits::Vector_3;
  using Function = Lattice_function<Traits>;
  using Triangle = std::array<std::uint32_t, 3>;
  static constexpr std::size_t slab = 32; // planes

public:
  Vertex_projection(const Function& function, Extraction& extraction,
                    const std::vector<Inner_vertex<FT>>& inner_vertices, Isosurface_3<Kernel>& surface)
      : function_(function), extraction_(extraction), numbering_(extraction.numbering()),
        inner_vertices_(inner_vertices), surface_(surface), evaluations_(numbering_.number_of_planes()),
        flipped_(numbering_.number_of_planes()) {
    Slab linear;
    for (std::size_t k = 0; k < numbering_.number_of_planes(); k += slab) linear = project(k, linear);
    undo_flips();
    surface_.function_evaluations += std::accumulate(evaluations_.begin(), evaluations_.end(), std::size_t(0));
  }

private:
  /// The linear positions of vertices with successive numbers.
  struct Slab {
    std::size_t first = 0;
    std::vector<Point_3> points;
    const Point_3& operator[](std::size_t v) const { return points[v - first]; }
  };

  /// Projects the vertices on edges from plane `first` on and those in the cells below; returns their linear positions.
  Slab project(std::size_t first, const Slab& below) {
    const std::size_t end = std::min(first + slab, numbering_.number_of_planes());
    const auto vertices = [&](std::size_t k) { return numbering_.vertices_of_plane(k); };
    const std::size_t first_kept = vertices(first > 0 ? first - 1 : 0).first;
    Slab linear{first_kept, {}};
    if (first > 0) linear.points.assign(&below[first_kept], &below[first_kept] + (vertices(first).first - first_kept));
    linear.points.insert(linear.points.end(), surface_.points.begin() + std::ptrdiff_t(vertices(first).first),
                         surface_.points.begin() + std::ptrdiff_t(vertices(end - 1).end));
    parallel_for<ConcurrencyTag>(first, end, [&](std::size_t k) {
      extraction_.for_each_vertex_of_plane(
          k, [&](std::size_t v, std::size_t i, std::size_t j, std::size_t, std::size_t axis) {
            const auto edge = function_.edge({{i, j, k}, axis});
            evaluations_[k] += Function::evaluations(2);
            set_projected(v, k, intersect(edge, linear[v]));
            return edge.ends_at(surface_.points[v]);
          });
      const Index_range inner = numbering_.inner_vertices_of_layer(k);
      for (std::size_t v = inner.first; v < inner.end; ++v) set_projected(v, k, project_within_cell(inner_vertex(v)));
    });
    parallel_for<ConcurrencyTag>(first > 0 ? first - 1 : 0, end - 1, [&](std::size_t k) {
      const Index_range triangles = numbering_.triangles_of_layer(k);
      for (std::size_t t = triangles.first; t < triangles.end; ++t)
        if (is_flipped(t, [&](std::size_t v) { return is_inner(v) ? point_of(inner_vertex(v)) : linear[v]; }))
          flipped_[k].push_back(t);
    });
    return linear;
  }

  bool is_inner(std::size_t v) const { return v >= numbering_.number_of_edge_vertices(); }
  const Inner_vertex<FT>& inner_vertex(std::size_t v) const {
    return inner_vertices_[v - numbering_.number_of_edge_vertices()];
  }
  Point_3 point_of(const Inner_vertex<FT>& vertex) const { return function_.point(vertex.cell, vertex.offset); }

  void set_projected(std::size_t v, std::size_t k, const Surface_point_3<Kernel>& projected) {
    if (projected.has_converged) surface_.points[v] = projected.point;
    else surface_.vertex_status[v] = Point_status::UNCONVERGED;
    evaluations_[k] += projected.evaluations;
  }

  /// In lattice coordinates, so that the image of a surface under an affine map has the images of its vertices.
  template <class Linear>
  bool is_flipped(std::size_t t, const Linear& linear_point) const {
    const auto& steps = function_.lattice().steps();
    const auto normal = [&](const auto& p) {
      const auto n = CGAL::cross_product(p[1] - p[0], p[2] - p[0]);
      return Vector_3(n * steps[0], n * steps[1], n * steps[2]);
    };
    std::array<Point_3, 3> points, linear;
    for (std::size_t m = 0; m < 3; ++m) {
      points[m] = surface_.points[surface_.triangles[t][m]];
      linear[m] = linear_point(surface_.triangles[t][m]);
    }
    const FT cosine = normal(points) * normal(linear);
    if (cosine > FT(0)) return false;
    return (cosine < FT(0) && has_side(linear)) || (have_no_area(points) && !have_no_area(linear));
  }

  /// Whether a triangle has an area above the rounding of its coordinates.
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
    const auto at = [](const Point_3& q) { return std::array<FT, 3>{q.x(), q.y(), q.z()}; };
    return has_zero_area(at(p[0]), at(p[1]), at(p[2]));
  }

  void undo_flips() {
    std::vector<std::size_t> suspects;
    for (const auto& layer : flipped_) suspects.insert(suspects.end(), layer.begin(), layer.end());
    const auto linear = [&](std::size_t v) {
      if (is_inner(v)) return point_of(inner_vertex(v));
      evaluations_[0] += Function::evaluations(2);
      return function_.edge(*numbering_.edge_of(v)).linear_intersection();
    };
    for (std::size_t n = 0; n < suspects.size(); ++n) {
      if (!is_flipped(suspects[n], linear)) continue;
      const Triangle& flipped = surface_.triangles[suspects[n]];
      if (!has_side({linear(flipped[0]), linear(flipped[1]), linear(flipped[2])})) {
        // Beside a node whose value all but vanishes two vertices are the same but for rounding; the third is not to
        // blame if they get back what makes them differ.
        for (const std::size_t v : flipped) {
          const Point_3 position = linear(v);
          if ((surface_.points[v] - position).squared_length() <= squared_rounding(position))
            surface_.points[v] = position;
        }
        if (!is_flipped(suspects[n], linear)) continue;
      }
      for (const std::size_t v : flipped) {
        const Point_3 position = linear(v);
        if (surface_.points[v] == position) continue;
        surface_.points[v] = position;
        surface_.vertex_status[v] = Point_status::UNCONVERGED;
        ++surface_.repairs.flips_undone;
        const auto node = is_inner(v) ? inner_vertex(v).cell : numbering_.edge_of(v)->node;
        numbering_.for_each_triangle_around(node[1], node[2], [&](std::size_t t) {
          const Triangle& triangle = surface_.triangles[t];
          if (std::find(triangle.begin(), triangle.end(), v) != triangle.end()) suspects.push_back(t);
        });
      }
    }
  }

  /// A zero near a point in a cell: on the way to the wall of the cell along an axis, so that it stays inside.
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

  Surface_point_3<Kernel> intersect(const typename Function::Edge& edge, const Point_3& linear) const {
    const auto& traits = function_.traits();
    const auto& [a, b] = edge.ends;
    if constexpr (Function::has_samples) {
      // The spline need not have the signs of the samples: if it has no sign change here, its zero is looked for
      // nearby.
      using std::sqrt;
      const FT fa = traits.value(a), fb = traits.value(b);
      auto result = is_sign_change(fa, fb) ? intersect_segment(traits, a, b, fa, fb)
                                           : project_to_surface(traits, linear, FT(sqrt((b - a).squared_length())));
      result.evaluations += 2;
      return result;
    } else {
      return intersect_segment(traits, a, b, edge.values[0], edge.values[1]);
    }
  }

  const Function& function_;
  Extraction& extraction_;
  const Isosurface_numbering& numbering_;
  const std::vector<Inner_vertex<FT>>& inner_vertices_;
  Isosurface_3<Kernel>& surface_;
  std::vector<std::size_t> evaluations_;          // per plane
  std::vector<std::vector<std::size_t>> flipped_; // triangles per layer
};

} // namespace equiaffine::internal

#endif
