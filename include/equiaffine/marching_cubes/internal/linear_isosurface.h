// SPDX-License-Identifier: GPL-3.0-or-later
// Marching Cubes in passes that are parallel over planes of nodes or layers of cells: plan_isosurface finds the
// sub-case of every cell and numbers vertices and triangles, place_linearly computes them, and repair_mesh removes
// triangles without area.
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_LINEAR_ISOSURFACE_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_LINEAR_ISOSURFACE_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/marching_cubes/internal/isosurface_extraction.h>
#include <equiaffine/marching_cubes/internal/isosurface_numbering.h>
#include <equiaffine/marching_cubes/internal/marching_cubes_cases.h>
#include <equiaffine/marching_cubes/internal/zero_area_repair.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Value and partial derivative along `axis` of the trilinear interpolant of f at p in the unit cell.
template <class FT>
std::pair<FT, FT> trilinear(const std::array<FT, 8>& f, const std::array<FT, 3>& p, std::size_t axis) {
  std::array<FT, 2> ends{FT(0), FT(0)};
  for (std::size_t c = 0; c < 8; ++c) {
    FT weight(1);
    for (std::size_t a = 0; a < 3; ++a)
      if (a != axis) weight *= c >> a & 1 ? p[a] : FT(1) - p[a];
    ends[c >> axis & 1] += weight * f[c];
  }
  const FT slope = ends[1] - ends[0];
  return {ends[0] + p[axis] * slope, slope};
}

/// The position of an inner vertex in a cell, in cell coordinates: the mean of the vertices on some edges, moved
/// along the axis of the steepest slope onto the zero set of the trilinear interpolant if that stays within the cell.
template <class FT>
std::array<FT, 3> inner_vertex(const std::array<FT, 8>& f, std::span<const std::uint8_t> edges) {
  using std::abs;
  std::array<FT, 3> p{FT(0), FT(0), FT(0)};
  for (const int edge : edges) {
    const int c = first_corner(edge);
    const FT t = linear_zero(f[std::size_t(c)], f[std::size_t(second_corner(edge))]);
    for (int a = 0; a < 3; ++a) p[std::size_t(a)] += edge / 4 == a ? t : FT(c >> a & 1);
  }
  for (FT& x : p) x /= FT(double(edges.size()));
  std::size_t steepest = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (abs(trilinear(f, p, a).second) > abs(trilinear(f, p, steepest).second)) steepest = a;
  const auto [value, slope] = trilinear(f, p, steepest);
  const FT moved = p[steepest] - value / slope;
  if (moved > FT(0) && moved < FT(1)) p[steepest] = moved;
  return p;
}

/// Writes the points of the vertices on edges. Returns the rows in which a vertex lies at a node.
template <class ConcurrencyTag, class Grid>
Grid_rows place_on_edges(const Grid& grid, const Isosurface_plan& plan, typename Grid::Point* points) {
  const std::size_t planes = plan.signs.size()[2];
  Grid_rows rows(planes);
  parallel_for<ConcurrencyTag>(0, planes, [&](std::size_t k) {
    if constexpr (requires(std::span<const Grid_edge> edges) { grid.edges(edges); }) {
      for_each_batch(plan, plane_of_nodes(plan, k),
                     [&](std::span<const std::size_t> vertices, std::span<const Grid_edge> edges) {
                       const auto ends = grid.edges(edges);
                       for (std::size_t n = 0; n < edges.size(); ++n) {
                         points[vertices[n]] = ends[n].linear_intersection();
                         if (ends[n].ends_at(points[vertices[n]])) rows.add(edges[n].node[1], k);
                       }
                     });
    } else {
      for_each_vertex(plan, plane_of_nodes(plan, k),
                      [&](std::size_t v, std::size_t i, std::size_t j, std::size_t, auto axis) {
                        const auto vertex = grid.edge_vertex({i, j, k}, axis);
                        points[v] = vertex.point;
                        if (vertex.is_at_node) rows.add(j, k);
                      });
    }
  });
  return rows;
}

/// Writes the points of all vertices and the triangles. Calls keep_inner(vertex, cell, offset) for every vertex
/// inside a cell. Returns the rows of nodes around which triangles may have no area.
template <class ConcurrencyTag, class Grid, class KeepInner>
Grid_rows place_linearly(const Grid& grid, const Isosurface_plan& plan, typename Grid::Point* points,
                         Index_triangle* triangles, const KeepInner& keep_inner) {
  Grid_rows suspects = place_on_edges<ConcurrencyTag>(grid, plan, points);
  suspects.add(write_triangles<ConcurrencyTag>(
      plan, triangles, grid.is_left_handed(),
      [&](std::size_t first, std::size_t i, std::size_t j, std::size_t k, const auto& edges, const auto& written) {
        const std::array<std::size_t, 3> cell = {i, j, k};
        auto values = grid.cell_values(cell);
        for (auto& value : values) value -= grid.isovalue();
        for (std::size_t n = 0; n < edges.size(); ++n) {
          const auto offset = inner_vertex(values, edges[n]);
          points[first + n] = grid.point(cell, offset);
          keep_inner(first + n, cell, offset);
        }
        return any_zero_area(written, [&](std::size_t v) -> decltype(auto) { return grid.coordinates(points[v]); });
      }));
  return suspects;
}

/// The repairs, and whether the part of the grid is too small to decide on them.
struct Repair_report : Isosurface_repairs {
  bool is_undecided = false;
};

/// Removes triangles without area around the given rows. `properties` are arrays with one entry per vertex.
template <class Grid, class Triangles, class Points, class... Properties>
Repair_report repair_zero_areas(const Grid& grid, const Isosurface_numbering& numbering,
                                const std::vector<Inner_vertex<typename Grid::FT>>& inner_vertices,
                                const Grid_rows& suspects, Layer_bounds& bounds, Triangles& triangles, Points& points,
                                Properties&... properties) {
  const auto suspected_triangles = numbering.triangles_around(suspects);
  if (suspected_triangles.empty()) return {};
  const auto nudge = [&](std::size_t v, int round) {
    const auto edge = numbering.edge_of(v);
    const Vertex_place at = edge ? Vertex_place{edge->node, edge->axis}
                                 : place_of_inner_vertex(inner_vertices, *numbering.place_of_inner(v));
    const std::size_t place = 3 * grid.index_in_whole(at.node) + at.slot;
    const std::size_t axis = edge ? edge->axis : (place + std::size_t(round)) % 3;
    const auto old = points[v];
    const bool is_backward = edge && grid.is_nearer_to_end(*edge, old);
    points[v] = nudged(old, place, round, [&](double d) { return grid.moved(old, axis, is_backward ? -d : d); });
  };
  const auto coordinates = [&](std::size_t v) -> decltype(auto) { return grid.coordinates(points[v]); };
  const auto is_at_cut = [&](std::size_t v) {
    const auto edge = numbering.edge_of(v);
    return edge && grid.is_at_cut(*edge);
  };
  const std::span all_triangles(triangles);
  Zero_area_repair repair(all_triangles, suspected_triangles, coordinates, nudge, is_at_cut);
  const Isosurface_repairs repairs = repair.run();
  repair.remove(bounds, triangles, points, properties...);
  return {repairs, repair.is_undecided()};
}

/// Separates parts of a surface that touch in a vertex by duplicating it. `properties` are arrays with one entry per
/// vertex.
template <class Triangles, class Points, class... Properties>
void split_parts(Layer_bounds& bounds, Triangles& triangles, Points& points, Properties&... properties) {
  const auto append_copy = [](auto& array, std::size_t v) {
    const auto copy = array[v];
    array.push_back(copy);
  };
  std::vector<std::uint32_t> originals;
  split_fans(triangles, points.size(), [&](std::size_t v) {
    originals.push_back(std::uint32_t(v));
    append_copy(points, v);
    (append_copy(properties, v), ...);
  });
  if (!originals.empty()) place_copies_behind_originals(originals, bounds, triangles, points, properties...);
}

/// Removes triangles without area around the given rows, then separates parts of the surface that touch near nodes
/// without a value. `properties` are arrays with one entry per vertex.
template <class Grid, class Triangles, class Points, class... Properties>
Repair_report repair_mesh(const Grid& grid, const Isosurface_plan& plan,
                          const std::vector<Inner_vertex<typename Grid::FT>>& inner_vertices, const Grid_rows& suspects,
                          Layer_bounds& bounds, Triangles& triangles, Points& points, Properties&... properties) {
  const auto report =
      repair_zero_areas(grid, plan.numbering, inner_vertices, suspects, bounds, triangles, points, properties...);
  if (plan.has_undefined) split_parts(bounds, triangles, points, properties...);
  return report;
}

/// Removes the vertices at poles, given by one mark per vertex, with the triangles around them. Separates parts of
/// the surface that then touch in a vertex. `properties` are arrays with one entry per vertex.
template <class Kernel, class... Properties>
void remove_poles(Isosurface_3<Kernel>& surface, const std::vector<std::uint8_t>& is_at_pole, Layer_bounds& bounds,
                  Properties&... properties) {
  std::vector<std::size_t> removed_triangles;
  std::vector<bool> is_used(surface.points.size(), false);
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    const auto& t = surface.triangles[n];
    if (is_at_pole[t[0]] || is_at_pole[t[1]] || is_at_pole[t[2]]) removed_triangles.push_back(n);
    else is_used[t[0]] = is_used[t[1]] = is_used[t[2]] = true;
  }
  std::vector<std::uint32_t> removed_vertices;
  for (std::size_t v = 0; v < is_used.size(); ++v)
    if (!is_used[v]) removed_vertices.push_back(std::uint32_t(v));
  remove_from_mesh(removed_vertices, removed_triangles, bounds, surface.triangles, surface.points,
                   surface.vertex_status, properties...);
  split_parts(bounds, surface.triangles, surface.points, surface.vertex_status, properties...);
}

} // namespace equiaffine::internal

#endif
