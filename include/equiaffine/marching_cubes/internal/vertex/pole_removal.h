// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_POLE_REMOVAL_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_VERTEX_POLE_REMOVAL_H

#include <equiaffine/marching_cubes/internal/linear_isosurface.h>
#include <equiaffine/surface/Isosurface_3.h>
#include <equiaffine/surface/internal/shared/remove_isolated_vertices.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// Removes the vertices at poles, one mark per vertex, with the triangles around them. Parts of the surface that then
/// touch in a vertex get vertices of their own.
template <class Kernel>
void remove_poles(Isosurface_3<Kernel>& surface, const std::vector<std::uint8_t>& is_at_pole) {
  std::erase_if(surface.triangles,
                [&](const auto& t) { return is_at_pole[t[0]] || is_at_pole[t[1]] || is_at_pole[t[2]]; });
  remove_isolated_vertices(surface);
  split_parts(surface.triangles, surface.points, surface.vertex_status);
}

} // namespace equiaffine::internal

#endif
