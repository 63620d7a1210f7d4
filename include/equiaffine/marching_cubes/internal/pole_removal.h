// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_POLE_REMOVAL_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_POLE_REMOVAL_H

#include <equiaffine/marching_cubes/internal/linear_isosurface.h>
#include <equiaffine/surface/Isosurface_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// Removes the vertices that are in no triangle, and keeps the order of the others.
template <class Kernel>
void remove_isolated_vertices(Isosurface_3<Kernel>& surface) {
  std::vector<bool> is_used(surface.points.size(), false);
  for (const auto& triangle : surface.triangles)
    for (const std::uint32_t v : triangle) is_used[v] = true;
  std::vector<std::uint32_t> number(surface.points.size());
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    if (!is_used[v]) continue;
    surface.points[kept] = surface.points[v];
    surface.vertex_status[kept] = surface.vertex_status[v];
    number[v] = kept++;
  }
  surface.points.erase(surface.points.begin() + std::ptrdiff_t(kept), surface.points.end());
  surface.vertex_status.resize(kept);
  for (auto& triangle : surface.triangles)
    for (std::uint32_t& v : triangle) v = number[v];
}

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
