// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_PROJECT_WITHIN_CELL_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_PROJECT_WITHIN_CELL_H

#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/internal/sign_change.h>
#include <equiaffine/marching_cubes/internal/grid_elements.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>

#include <cstddef>

namespace equiaffine::internal {

/// Finds a zero of the function near a vertex inside a cell. It is looked for along each axis, between the vertex and
/// a wall a little within the cell, so that the vertex stays inside.
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

} // namespace equiaffine::internal

#endif
