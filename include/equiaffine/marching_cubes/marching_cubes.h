// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_H
#define EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/marching_cubes/Vertex_position.h>
#include <equiaffine/marching_cubes/internal/inner_vertex.h>
#include <equiaffine/marching_cubes/internal/isosurface_extraction.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/internal/sample_signs.h>
#include <equiaffine/marching_cubes/internal/split_fans.h>
#include <equiaffine/marching_cubes/internal/trilinear_cell.h>
#include <equiaffine/marching_cubes/internal/vertex_projection.h>
#include <equiaffine/marching_cubes/internal/zero_area_repair.h>
#include <equiaffine/surface/Isosurface_3.h>

#include <CGAL/Real_timer.h>
#include <CGAL/tags.h>

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine {

namespace internal {

/// The surface of a function on a lattice: topology from the signs and values at the nodes, then the vertices.
template <class ConcurrencyTag, bool SkipsEmptySpace, class Traits>
class Marching_cubes_3 {
  using FT = typename Traits::FT;
  using Kernel = Kernel_of<Traits>;
  using Point_3 = typename Traits::Point_3;
  using Function = Lattice_function<Traits>;

public:
  Marching_cubes_3(const Traits& traits, const Lattice_3<Kernel>& lattice) : function_(traits, lattice) {}

  Isosurface_3<Kernel> operator()(Vertex_position position) {
    CGAL::Real_timer timer;
    timer.start();
    Node_signs signs(function_.lattice().size());
    const Sign_sampler<ConcurrencyTag, SkipsEmptySpace, Traits> sampler(function_, signs);
    const auto choose = [&](std::size_t i, std::size_t j, std::size_t k, unsigned corner_signs) {
      return Trilinear_cell<FT>(function_.cell_values({i, j, k}), FT(0)).sub_case(corner_signs);
    };
    Isosurface_extraction<ConcurrencyTag, decltype(choose)> extraction(signs, Case_table::instance(), choose);
    place_linearly(extraction);
    result_.function_evaluations +=
        sampler.evaluations() + Function::evaluations(8 * extraction.number_of_ambiguous_cells());
    result_.sampling_seconds = timer.time();
    if (position == Vertex_position::PROJECTED)
      Vertex_projection<ConcurrencyTag, Traits, decltype(extraction)>(function_, extraction, inner_vertices_, result_);
    repair(extraction);
    if (signs.has_undefined())
      split_fans(result_.triangles, result_.points.size(), [&](std::size_t v) {
        result_.points.push_back(Point_3(result_.points[v]));
        result_.vertex_status.push_back(Point_status(result_.vertex_status[v]));
      });
    result_.projection_seconds = timer.time() - result_.sampling_seconds;
    return std::move(result_);
  }

private:
  template <class Extraction>
  void place_linearly(Extraction& extraction) {
    const auto& numbering = extraction.numbering();
    const std::size_t first_inner = numbering.number_of_edge_vertices();
    auto& points = result_.points;
    resize_with_large_pages(points, numbering.number_of_vertices());
    result_.vertex_status.assign(numbering.number_of_vertices(), Point_status::REGULAR);
    resize_with_large_pages(result_.triangles, numbering.number_of_triangles());
    extraction.for_each_edge_vertex([&](std::size_t v, std::size_t i, std::size_t j, std::size_t k, auto axis) {
      const auto edge = function_.edge({{i, j, k}, axis});
      points[v] = edge.linear_intersection();
      return edge.ends_at(points[v]);
    });
    inner_vertices_.resize(numbering.number_of_vertices() - first_inner);
    extraction.emit(
        result_.triangles.data(), function_.lattice().determinant() < FT(0),
        [&](std::size_t first, std::size_t i, std::size_t j, std::size_t k, const auto& edges, const auto& triangles) {
          const auto f = function_.cell_values({i, j, k});
          for (std::size_t n = 0; n < edges.size(); ++n) {
            const auto offset = inner_vertex(f, edges[n]);
            points[first + n] = function_.point({i, j, k}, offset);
            inner_vertices_[first + n - first_inner] = {{i, j, k}, offset};
          }
          return any_zero_area(triangles, [&](std::size_t v) { return coordinates(points[v]); });
        });
    std::size_t cells = 0;
    for (std::size_t n = 0; n < inner_vertices_.size(); ++n)
      if (n == 0 || inner_vertices_[n].cell != inner_vertices_[n - 1].cell) ++cells;
    result_.function_evaluations += Function::evaluations(2 * first_inner + 8 * cells);
  }

  template <class Extraction>
  void repair(const Extraction& extraction) {
    const auto part = extraction.doubtful_triangles();
    if (part.empty()) return;
    auto& points = result_.points;
    const auto nudge = [&](std::size_t v, int round) {
      const auto edge = extraction.numbering().edge_of(v);
      auto direction = function_.lattice().steps()[edge ? edge->axis : (v + std::size_t(round)) % 3];
      const Point_3 old = points[v];
      if (edge) {
        const auto ends = function_.edge(*edge).ends;
        if ((ends[1] - old).squared_length() < (old - ends[0]).squared_length()) direction = -direction;
      }
      points[v] = nudged(old, v, round, [&](double d) { return old + FT(d) * direction; });
    };
    const auto at = [&](std::size_t v) { return coordinates(points[v]); };
    Zero_area_repair repair(std::span(result_.triangles), part, at, nudge);
    const std::size_t flips_undone = result_.repairs.flips_undone;
    result_.repairs = repair.repairs();
    result_.repairs.flips_undone = flips_undone;
    repair.remove(extraction.numbering(), result_.triangles, points, result_.vertex_status);
  }

  static std::array<FT, 3> coordinates(const Point_3& p) { return {p.x(), p.y(), p.z()}; }

  const Function function_;
  Isosurface_3<Kernel> result_;
  std::vector<Inner_vertex<FT>> inner_vertices_;
};

} // namespace internal

/// The zero set of a function, by Marching Cubes (Lorensen, Cline 1987): a triangle mesh with a vertex on every edge of
/// a node grid at whose ends the function has different signs. A value of zero counts as positive. The grid is the
/// lattice of a model of LatticeImplicitFunctionTraits_3, else `sampling_lattice(traits, number_of_nodes)`.
///
/// The mesh is an oriented 2-manifold for every input, with boundary where the surface leaves the grid or meets a node
/// without a value (NaN); parts that touch there have vertices of their own. Normals point along the gradient. Its
/// topology is exactly that of the zero set of the values' trilinear interpolant, zeros taken as positive; cells whose
/// signs leave it open have vertices inside where a tunnel or a curved disc needs them. Projection does not change it,
/// and undoes moves that turn a triangle over or leave it without area. Where the surface passes through nodes,
/// triangles without area are contracted or opened and components without area dropped. All this is counted in
/// `repairs`. Nothing is found where the surface crosses no grid edge.
///
/// Named parameters: `number_of_nodes` (64), `vertex_position` (PROJECTED), `skip_empty_space` (not given).
/// The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit. Time: one evaluation per node,
/// of those near the surface when empty space is skipped; 4 more per vertex, and 4 to 6 with gradient. Memory: output,
/// one bit per node, and what some planes of nodes need.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          class NamedParameters = internal::No_parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes(const Traits& traits, const NamedParameters& parameters = {}) {
  internal::check_parameters<NamedParameters, internal::Number_of_nodes_tag, internal::Vertex_position_tag,
                             internal::Skip_empty_space_tag>();
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
