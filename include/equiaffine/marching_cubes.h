// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_H
#define EQUIAFFINE_MARCHING_CUBES_H

#include <equiaffine/Batch_function_traits_3.h>
#include <equiaffine/Indexed_triangle_mesh_3.h>
#include <equiaffine/internal/inner_vertex.h>
#include <equiaffine/internal/isosurface_extraction.h>
#include <equiaffine/internal/sample_signs.h>
#include <equiaffine/named_parameters.h>
#include <equiaffine/project_to_surface.h>

#include <CGAL/Real_timer.h>
#include <CGAL/tags.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <vector>

namespace equiaffine {

/// What a sampler makes of the zero set of a function: a mesh and what is known about it.
template <class Kernel>
struct Isosurface_3 : Indexed_triangle_mesh_3<Kernel> {
  /// Per point: REGULAR, or UNCONVERGED where it could not be put on the surface and stays at the linear intersection.
  std::vector<Point_status> vertex_status;
  std::size_t function_evaluations = 0; ///< of f, with or without derivatives
  double sampling_seconds = 0, projection_seconds = 0;
};

namespace internal {

/// The surface of a function on a lattice: topology from the signs and values at the nodes, then the vertices.
template <class ConcurrencyTag, bool SkipsEmptySpace, class Traits>
class Marching_cubes_3 {
  using FT = typename Traits::FT;
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Node = std::array<std::size_t, 3>;

public:
  Marching_cubes_3(const Traits& traits, const Lattice_3<Kernel>& lattice) : traits_(traits), lattice_(lattice) {}

  Isosurface_3<Kernel> operator()(Vertex_position position) {
    CGAL::Real_timer timer;
    timer.start();
    Node_signs signs(lattice_.size());
    const Sign_sampler<ConcurrencyTag, SkipsEmptySpace, Traits> sampler(traits_, lattice_, signs);
    const auto value = [&](std::size_t i, std::size_t j, std::size_t k) { return node_value({i, j, k}); };
    const Isosurface_extraction<ConcurrencyTag, decltype(value)> extraction(signs, value, FT(0));
    result_.points.resize(extraction.number_of_vertices());
    result_.vertex_status.assign(extraction.number_of_vertices(), Point_status::REGULAR);
    result_.triangles.resize(extraction.number_of_triangles());
    evaluations_ = sampler.evaluations() + node_evaluations(8 * extraction.number_of_ambiguous_cells());
    extraction.emit(result_.triangles.data(), lattice_.determinant() < FT(0),
                    [&](std::size_t v, std::size_t i, std::size_t j, std::size_t k, const auto& edges) {
                      place_inner_vertex(v, {i, j, k}, edges, position);
                    });
    result_.sampling_seconds = timer.time();
    extraction.for_each_edge_vertex([&](std::size_t v, std::size_t i, std::size_t j, std::size_t k, std::size_t axis) {
      place_edge_vertex(v, {i, j, k}, axis, position);
    });
    result_.projection_seconds = timer.time() - result_.sampling_seconds;
    result_.function_evaluations = evaluations_;
    return std::move(result_);
  }

private:
  Point_3 point(const Node& n, const std::array<FT, 3>& offset = {FT(0), FT(0), FT(0)}) const {
    return lattice_.point(FT(double(n[0])) + offset[0], FT(double(n[1])) + offset[1], FT(double(n[2])) + offset[2]);
  }

  FT node_value(const Node& n) const {
    if constexpr (LatticeImplicitFunctionTraits_3<Traits>) return traits_.sample(n[0], n[1], n[2]);
    else return traits_.value(point(n));
  }

  /// Samples are there already, a function is evaluated anew.
  static constexpr std::size_t node_evaluations(std::size_t n) {
    return LatticeImplicitFunctionTraits_3<Traits> ? 0 : n;
  }

  void place_edge_vertex(std::size_t v, const Node& first, std::size_t axis, Vertex_position position) {
    Node second = first;
    ++second[axis];
    const Point_3 a = point(first), b = point(second);
    const FT fa = node_value(first), fb = node_value(second);
    const Point_3 linear = a + linear_zero(fa, fb) * (b - a);
    std::size_t evaluations = node_evaluations(2);
    result_.points[v] = linear;
    if (position == Vertex_position::PROJECTED) {
      const auto surface_point = intersect_edge(a, b, fa, fb, linear);
      if (surface_point.has_converged) result_.points[v] = surface_point.point;
      else result_.vertex_status[v] = Point_status::UNCONVERGED;
      evaluations += surface_point.evaluations;
    }
    evaluations_.fetch_add(evaluations, std::memory_order_relaxed);
  }

  void place_inner_vertex(std::size_t v, const Node& cell, const Polygon& edges, Vertex_position position) {
    std::array<FT, 8> f;
    for (std::size_t c = 0; c < 8; ++c)
      f[c] = node_value({cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)});
    const std::array<FT, 3> offset = inner_vertex(f, edges);
    std::size_t evaluations = node_evaluations(8);
    result_.points[v] = point(cell, offset);
    if (position == Vertex_position::PROJECTED) {
      const auto projected = project_within(cell, offset);
      if (projected.has_converged) result_.points[v] = projected.point;
      else result_.vertex_status[v] = Point_status::UNCONVERGED;
      evaluations += projected.evaluations;
    }
    evaluations_.fetch_add(evaluations, std::memory_order_relaxed);
  }

  /// A zero near a point in a cell: on the way to the wall of the cell along an axis, so that it stays inside.
  Surface_point_3<Kernel> project_within(const Node& cell, const std::array<FT, 3>& offset) const {
    const Point_3 p = point(cell, offset);
    Surface_point_3<Kernel> best{p, false, 1};
    const FT value = traits_.value(p);
    if (value == FT(0)) return {p, true, 1};
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const FT& wall : {FT(0.0625), FT(0.9375)}) {
        auto end = offset;
        end[axis] = wall;
        const Point_3 q = point(cell, end);
        const FT end_value = traits_.value(q);
        ++best.evaluations;
        if (!(value < FT(0) ? end_value >= FT(0) : end_value < FT(0)) || p == q) continue;
        const auto found = intersect_segment(traits_, p, q, value, end_value);
        best.evaluations += found.evaluations;
        if (!found.has_converged) continue;
        if (!best.has_converged || (found.point - p).squared_length() < (best.point - p).squared_length())
          best.point = found.point, best.has_converged = true;
      }
    return best;
  }

  Surface_point_3<Kernel> intersect_edge(const Point_3& a, const Point_3& b, const FT& first, const FT& second,
                                         const Point_3& linear) const {
    if constexpr (LatticeImplicitFunctionTraits_3<Traits>) {
      // The spline need not have the signs of the samples: if it has no sign change here, its zero is looked for nearby.
      using std::sqrt;
      const FT fa = traits_.value(a), fb = traits_.value(b);
      const bool has_sign_change = (fa >= FT(0) && fb < FT(0)) || (fa < FT(0) && fb >= FT(0));
      auto result = has_sign_change ? intersect_segment(traits_, a, b, fa, fb)
                                    : project_to_surface(traits_, linear, FT(sqrt((b - a).squared_length())));
      result.evaluations += 2;
      return result;
    } else {
      return intersect_segment(traits_, a, b, first, second);
    }
  }

  const Batch_function_traits_3<Traits> traits_;
  const Lattice_3<Kernel> lattice_;
  Isosurface_3<Kernel> result_;
  std::atomic<std::size_t> evaluations_ = 0;
};

} // namespace internal

/// The zero set of a function, by Marching Cubes (Lorensen, Cline 1987): a triangle mesh with a vertex on every edge of a
/// node grid at whose ends the function has different signs. A value of zero counts as positive. The grid is the lattice of a model of
/// LatticeImplicitFunctionTraits_3, else `sampling_lattice(traits, number_of_nodes)`.
///
/// The mesh is an oriented 2-manifold for every input, with boundary where the surface leaves the grid or meets a node
/// without a value (NaN); normals point along the gradient. Vertices stay on their grid edges when projected, so
/// projection changes neither the topology nor the orientation of the triangles' projections along the axes. Nothing is found
/// where the surface crosses no grid edge. A vertex at a node with value exactly zero can make triangles of zero area.
///
/// Named parameters: `number_of_nodes` (64), `vertex_position` (PROJECTED).
/// The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit. Time: one evaluation per node, 4
/// to 6 with gradient per vertex. Memory: output plus O(nodes of a plane).
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          class NamedParameters = internal::No_parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes(const Traits& traits, const NamedParameters& parameters = {}) {
  using Size = std::array<std::size_t, 3>;
  const auto lattice = [&] {
    if constexpr (LatticeImplicitFunctionTraits_3<Traits>) return traits.lattice();
    else
      return sampling_lattice(traits,
                              internal::get_parameter<internal::Number_of_nodes_tag>(parameters, Size{64, 64, 64}));
  }();
  const auto position = internal::get_parameter<internal::Vertex_position_tag>(parameters, Vertex_position::PROJECTED);
  constexpr bool skips_empty_space = internal::has_parameter<internal::Skip_empty_space_tag, NamedParameters>;
  return internal::Marching_cubes_3<ConcurrencyTag, skips_empty_space, Traits>(traits, lattice)(position);
}

} // namespace equiaffine

#endif
