// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_H
#define EQUIAFFINE_MARCHING_CUBES_H

#include <equiaffine/Batch_function_traits_3.h>
#include <equiaffine/Indexed_triangle_mesh_3.h>
#include <equiaffine/internal/inner_vertex.h>
#include <equiaffine/internal/isosurface_extraction.h>
#include <equiaffine/internal/sample_signs.h>
#include <equiaffine/internal/split_fans.h>
#include <equiaffine/internal/trilinear_cell.h>
#include <equiaffine/internal/zero_area_repair.h>
#include <equiaffine/named_parameters.h>
#include <equiaffine/project_to_surface.h>

#include <CGAL/Kernel/global_functions_3.h>
#include <CGAL/Real_timer.h>
#include <CGAL/tags.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine {

/// What a sampler makes of the zero set of a function: a mesh and what is known about it.
template <class Kernel>
struct Isosurface_3 : Indexed_triangle_mesh_3<Kernel> {
  /// Per point: REGULAR, or UNCONVERGED where it could not be put on the surface and stays at the linear intersection.
  std::vector<Point_status> vertex_status;
  Isosurface_repairs repairs;
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

  struct Inner_vertex {
    Node cell;
    std::array<FT, 3> offset; // in the cell
  };

public:
  Marching_cubes_3(const Traits& traits, const Lattice_3<Kernel>& lattice) : traits_(traits), lattice_(lattice) {}

  Isosurface_3<Kernel> operator()(Vertex_position position) {
    CGAL::Real_timer timer;
    timer.start();
    Node_signs signs(lattice_.size());
    const Sign_sampler<ConcurrencyTag, SkipsEmptySpace, Traits> sampler(traits_, lattice_, signs);
    const auto choose = [&](std::size_t i, std::size_t j, std::size_t k, unsigned corner_signs) {
      return Trilinear_cell<FT>(cell_values({i, j, k}), FT(0)).sub_case(corner_signs);
    };
    Isosurface_extraction<ConcurrencyTag, decltype(choose)> extraction(signs, Case_table::instance(), choose);
    auto& points = result_.points;
    points.resize(extraction.number_of_vertices());
    result_.vertex_status.assign(extraction.number_of_vertices(), Point_status::REGULAR);
    result_.triangles.resize(extraction.number_of_triangles());
    evaluations_ = sampler.evaluations() + node_evaluations(8 * extraction.number_of_ambiguous_cells());
    place_linearly(extraction);
    result_.sampling_seconds = timer.time();
    if (position == Vertex_position::PROJECTED) project(extraction);
    repair(extraction);
    if (signs.has_undefined())
      split_fans(result_.triangles, points.size(), [&](std::size_t v) {
        points.push_back(Point_3(points[v]));
        result_.vertex_status.push_back(Point_status(result_.vertex_status[v]));
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

  void count_evaluations(std::size_t n) {
    if (n > 0) evaluations_.fetch_add(n, std::memory_order_relaxed);
  }

  std::array<FT, 8> cell_values(const Node& cell) const {
    std::array<FT, 8> f;
    for (std::size_t c = 0; c < 8; ++c)
      f[c] = node_value({cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2)});
    return f;
  }

  template <class Extraction>
  void place_linearly(Extraction& extraction) {
    auto& points = result_.points;
    extraction.for_each_edge_vertex([&](std::size_t v, std::size_t i, std::size_t j, std::size_t k, std::size_t axis) {
      const auto [a, b] = ends({{i, j, k}, axis});
      points[v] = a + linear_zero(node_value({i, j, k}), node_value(next({i, j, k}, axis))) * (b - a);
      count_evaluations(node_evaluations(2));
      return points[v] == a || points[v] == b;
    });
    inner_vertices_.resize(extraction.number_of_vertices() - extraction.number_of_edge_vertices());
    extraction.emit(
        result_.triangles.data(), lattice_.determinant() < FT(0),
        [&](std::size_t first, std::size_t i, std::size_t j, std::size_t k, const auto& edges, const auto& triangles) {
          const auto f = cell_values({i, j, k});
          for (std::size_t n = 0; n < edges.size(); ++n) {
            const auto offset = inner_vertex(f, edges[n]);
            points[first + n] = point({i, j, k}, offset);
            inner_vertices_[first + n - extraction.number_of_edge_vertices()] = {{i, j, k}, offset};
          }
          count_evaluations(node_evaluations(8));
          return any_zero_area(triangles, [&](std::size_t v) { return coordinates(points[v]); });
        });
  }

  /// Puts the vertices on the surface of the function. A triangle that would turn over, away from the side to which its
  /// linear version looks, keeps its vertices.
  template <class Extraction>
  void project(Extraction& extraction) {
    std::vector<Point_3> linear = result_.points;
    auto& points = result_.points;
    extraction.for_each_edge_vertex([&](std::size_t v, std::size_t i, std::size_t j, std::size_t k, std::size_t axis) {
      const auto [a, b] = ends({{i, j, k}, axis});
      set_projected(v, intersect_edge(a, b, node_value({i, j, k}), node_value(next({i, j, k}, axis)), linear[v]));
      count_evaluations(node_evaluations(2));
      return points[v] == a || points[v] == b;
    });
    parallel_for<ConcurrencyTag>(
        0, inner_vertices_.size(),
        [&](std::size_t n) {
          const Inner_vertex& vertex = inner_vertices_[n];
          set_projected(extraction.number_of_edge_vertices() + n, project_within(vertex.cell, vertex.offset));
        },
        16);
    undo_flips(linear);
  }

  void set_projected(std::size_t v, const Surface_point_3<Kernel>& projected) {
    if (projected.has_converged) result_.points[v] = projected.point;
    else result_.vertex_status[v] = Point_status::UNCONVERGED;
    count_evaluations(projected.evaluations);
  }

  void undo_flips(const std::vector<Point_3>& linear) {
    auto& points = result_.points;
    // In lattice coordinates, so that the image of a surface under an affine map has the images of its vertices.
    const auto& steps = lattice_.steps();
    const auto normal = [&](const std::vector<Point_3>& p, const auto& t) {
      const auto n = CGAL::cross_product(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
      return typename Traits::Vector_3(n * steps[0], n * steps[1], n * steps[2]);
    };
    for (bool has_changed = true; std::exchange(has_changed, false);)
      for (const auto& t : result_.triangles) {
        if (!(normal(points, t) * normal(linear, t) < FT(0))) continue;
        for (const std::size_t v : t) {
          if (points[v] == linear[v]) continue;
          points[v] = linear[v];
          result_.vertex_status[v] = Point_status::UNCONVERGED;
          ++result_.repairs.flips_undone;
          has_changed = true;
        }
      }
  }

  template <class Extraction>
  void repair(const Extraction& extraction) {
    const auto part = extraction.doubtful_triangles();
    if (part.empty()) return;
    auto& points = result_.points;
    const auto nudge = [&](std::size_t v, int round) {
      const auto edge = extraction.edge_of(v);
      auto direction = lattice_.steps()[edge ? edge->axis : (v + std::size_t(round)) % 3];
      const Point_3 old = points[v];
      if (edge) {
        const auto [a, b] = ends(*edge);
        if ((b - old).squared_length() < (old - a).squared_length()) direction = -direction;
      }
      points[v] = nudged(old, v, round, [&](double d) { return old + FT(d) * direction; });
    };
    const auto at = [&](std::size_t v) { return coordinates(points[v]); };
    Zero_area_repair repair(std::span(result_.triangles), part, at, nudge);
    const std::size_t flips_undone = result_.repairs.flips_undone;
    result_.repairs = repair.repairs();
    result_.repairs.flips_undone = flips_undone;
    const auto for_each_part = [&](std::size_t v, const auto& visit) {
      extraction.for_each_part_with_vertices_from(v, visit);
    };
    repair.remove(result_.triangles, for_each_part, points, result_.vertex_status);
  }

  static std::array<FT, 3> coordinates(const Point_3& p) { return {p.x(), p.y(), p.z()}; }

  static Node next(Node node, std::size_t axis) {
    ++node[axis];
    return node;
  }

  std::array<Point_3, 2> ends(const Grid_edge& edge) const {
    return {point(edge.node), point(next(edge.node, edge.axis))};
  }

  /// A zero near a point in a cell: on the way to the wall of the cell along an axis, so that it stays inside.
  Surface_point_3<Kernel> project_within(const Node& cell, const std::array<FT, 3>& offset) const {
    const Point_3 p = point(cell, offset);
    Surface_point_3<Kernel> best{p, false, 1};
    FT best_distance(1); // in squared steps of the lattice
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
        const FT distance = (found.point - p).squared_length() / lattice_.steps()[axis].squared_length();
        if (!found.has_converged || !(distance < best_distance)) continue;
        best.point = found.point;
        best.has_converged = true;
        best_distance = distance;
      }
    return best;
  }

  Surface_point_3<Kernel> intersect_edge(const Point_3& a, const Point_3& b, const FT& first, const FT& second,
                                         const Point_3& linear) const {
    if constexpr (LatticeImplicitFunctionTraits_3<Traits>) {
      // The spline need not have the signs of the samples: if it has no sign change here, its zero is looked for
      // nearby.
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
  std::vector<Inner_vertex> inner_vertices_;
  std::atomic<std::size_t> evaluations_ = 0;
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
/// and undoes moves that turn a triangle over. Where the surface passes through nodes, triangles without area are
/// contracted or opened and components without area dropped. All this is counted in `repairs`. Nothing is found where
/// the surface crosses no grid edge.
///
/// Named parameters: `number_of_nodes` (64), `vertex_position` (PROJECTED), `skip_empty_space` (not given).
/// The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit. Time: one evaluation per node,
/// of those near the surface when empty space is skipped; 4 more per vertex, and 4 to 6 with gradient. Memory: output,
/// one bit per node, and the points once more while they are projected.
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
