// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_ARRAY_ISOSURFACE_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_ARRAY_ISOSURFACE_H

#include <equiaffine/marching_cubes/Array_isosurface_3.h>
#include <equiaffine/marching_cubes/internal/array_grid.h>
#include <equiaffine/marching_cubes/internal/isosurface_plan.h>
#include <equiaffine/marching_cubes/internal/linear_isosurface.h>

#include <array>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// Computes the surface of an array with the cases of the given table.
template <class ConcurrencyTag, class FT>
Array_isosurface_3<FT> isosurface_of_array(const Array_grid<FT>& grid, const Case_table& table) {
  const Node_signs signs = node_signs<ConcurrencyTag>(grid);
  const Isosurface_plan plan = plan_isosurface<ConcurrencyTag>(signs, grid, table);
  Array_isosurface_3<FT> surface;
  surface.points.resize(plan.numbering.number_of_vertices());
  surface.triangles.resize(plan.numbering.number_of_triangles());
  std::vector<Inner_vertex<FT>> inner_vertices(plan.numbering.number_of_inner_vertices());
  const auto keep_inner = [&](std::size_t v, const std::array<std::size_t, 3>& cell, const std::array<FT, 3>& offset) {
    inner_vertices[plan.numbering.place_of_inner(v, cell[2])] = {cell, offset};
  };
  const Grid_rows suspects =
      place_linearly<ConcurrencyTag>(grid, plan, surface.points.data(), surface.triangles.data(), keep_inner);
  Layer_bounds bounds(plan.numbering);
  surface.repairs = repair_mesh(grid, plan, inner_vertices, suspects, bounds, surface.triangles, surface.points);
  return surface;
}

} // namespace equiaffine::internal

#endif
