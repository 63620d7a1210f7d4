// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_POLE_REMOVAL_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_POLE_REMOVAL_H

#include <equiaffine/marching_cubes/internal/linear_isosurface.h>
#include <equiaffine/marching_cubes/internal/remove_from_mesh.h>
#include <equiaffine/mesh/Isosurface_3.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// Removes the vertices at poles, one mark per vertex, with the triangles around them. Parts of the surface that then
/// touch in a vertex get vertices of their own. `properties` are arrays with an entry per vertex.
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
