// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_LATTICE_ISOSURFACE_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_LATTICE_ISOSURFACE_H

#include <equiaffine/base/internal/large_pages.h>
#include <equiaffine/marching_cubes/Vertex_position.h>
#include <equiaffine/marching_cubes/internal/isosurface_plan.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/internal/linear_isosurface.h>
#include <equiaffine/marching_cubes/internal/pole_removal.h>
#include <equiaffine/marching_cubes/internal/sample_signs.h>
#include <equiaffine/marching_cubes/internal/vertex_place.h>
#include <equiaffine/marching_cubes/internal/vertex_projection.h>
#include <equiaffine/mesh/Isosurface_3.h>

#include <CGAL/Real_timer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Counts the cells that contain the given vertices, which are ordered like their cells.
template <class FT>
std::size_t number_of_cells(const std::vector<Inner_vertex<FT>>& vertices) {
  std::size_t cells = 0;
  for (std::size_t n = 0; n < vertices.size(); ++n)
    if (n == 0 || vertices[n].cell != vertices[n - 1].cell) ++cells;
  return cells;
}

/// Repairs the mesh, then removes the vertices at poles, which the repairs may renumber. `properties` are arrays with an
/// entry per vertex.
template <class Function, class FT, class Kernel, class... Properties>
Repair_report repair_and_remove_poles(const Function& function, const Isosurface_plan& plan,
                                      const std::vector<Inner_vertex<FT>>& inner_vertices, const Grid_rows& suspects,
                                      const std::vector<std::size_t>& poles, Layer_bounds& bounds,
                                      Isosurface_3<Kernel>& surface, Properties&... properties) {
  auto& [points, triangles] = static_cast<Indexed_triangle_mesh_3<Kernel>&>(surface);
  auto& status = surface.vertex_status;
  if (poles.empty())
    return repair_mesh(function, plan, inner_vertices, suspects, bounds, triangles, points, status, properties...);
  std::vector<std::uint8_t> is_at_pole(points.size(), 0);
  for (const std::size_t v : poles) is_at_pole[v] = 1;
  Repair_report report = repair_mesh(function, plan, inner_vertices, suspects, bounds, triangles, points, status,
                                     properties..., is_at_pole);
  remove_poles(surface, is_at_pole, bounds, properties...);
  report.vertices_at_poles = poles.size();
  return report;
}

/// A surface, with what is needed to take it apart. Where the lattice is cut, `is_undecided` says that a larger part of
/// it has to be known.
template <class Kernel>
struct Isosurface_in_layers {
  Isosurface_3<Kernel> surface;
  Layer_bounds bounds;
  bool is_undecided;
  std::vector<Vertex_id> ids; ///< of the vertices, if they were asked for
};

/// Computes the surface of a function on a lattice, or on a part of it: first the topology from the signs and values at
/// the nodes, then the vertices.
template <class ConcurrencyTag, bool SkipsEmptySpace, bool WithIds = false, class Traits>
Isosurface_in_layers<Kernel_of<Traits>> isosurface_on_lattice(const Lattice_function<Traits>& function,
                                                              Vertex_position position) {
  using FT = typename Traits::FT;
  using Cell = std::array<std::size_t, 3>;
  CGAL::Real_timer timer;
  timer.start();
  const Sampled_signs sampled = sample_signs<ConcurrencyTag, SkipsEmptySpace>(function);
  const Isosurface_plan plan = plan_isosurface<ConcurrencyTag>(sampled.signs, function, Case_table::instance());
  const std::size_t vertices = plan.numbering.number_of_vertices();
  const std::size_t inner = plan.numbering.number_of_inner_vertices(), edge_vertices = vertices - inner;

  Isosurface_3<Kernel_of<Traits>> surface;
  resize_with_large_pages(surface.points, vertices);
  surface.vertex_status.assign(vertices, Point_status::REGULAR);
  resize_with_large_pages(surface.triangles, plan.numbering.number_of_triangles());
  std::vector<Inner_vertex<FT>> inner_vertices(inner);
  const auto keep_inner = [&](std::size_t v, const Cell& cell, const std::array<FT, 3>& offset) {
    inner_vertices[plan.numbering.place_of_inner(v, cell[2])] = {cell, offset};
  };
  Grid_rows suspects =
      place_linearly<ConcurrencyTag>(function, plan, surface.points.data(), surface.triangles.data(), keep_inner);
  const std::size_t evaluated_cells = plan.number_of_ambiguous_cells() + number_of_cells(inner_vertices);
  surface.function_evaluations =
      sampled.evaluations + Lattice_function<Traits>::evaluations(2 * edge_vertices + 8 * evaluated_cells);
  surface.sampling_seconds = timer.time();

  std::size_t flips_undone = 0;
  std::vector<std::size_t> poles;
  if (position == Vertex_position::PROJECTED) {
    const Projection_report report = project_vertices<ConcurrencyTag>(function, plan, inner_vertices, surface);
    surface.function_evaluations += report.evaluations;
    suspects.add(report.suspects);
    flips_undone = report.flips_undone;
    poles = report.poles;
  }
  Layer_bounds bounds(plan.numbering);
  std::vector<Vertex_id> ids;
  const Repair_report report = [&] {
    const auto repair = [&](auto&... properties) {
      return repair_and_remove_poles(function, plan, inner_vertices, suspects, poles, bounds, surface, properties...);
    };
    if constexpr (!WithIds) return repair();
    ids = vertex_ids<ConcurrencyTag>(function, plan, inner_vertices);
    return repair(ids);
  }();
  tell_copies_apart(ids);
  surface.repairs = report;
  surface.repairs.flips_undone = flips_undone;
  surface.projection_seconds = timer.time() - surface.sampling_seconds;
  return {std::move(surface), std::move(bounds), report.is_undecided, std::move(ids)};
}

} // namespace equiaffine::internal

#endif
