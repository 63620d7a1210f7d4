// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_SURFACE_PARTS_H
#define EQUIAFFINE_MESH_INTERNAL_SURFACE_PARTS_H

#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// The connected components of a surface, as disjoint sets of vertices.
template <class Kernel>
Disjoint_sets<std::uint32_t> components_of(const Isosurface_3<Kernel>& surface) {
  Disjoint_sets<std::uint32_t> components(surface.points.size());
  for (const auto& [a, b, c] : surface.triangles) components.unite(a, b), components.unite(a, c);
  return components;
}

/// Removes vertices that are in no triangle, preserving the order of the others.
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

} // namespace equiaffine::internal

#endif
