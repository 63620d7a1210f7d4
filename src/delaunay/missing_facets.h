// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_MISSING_FACETS_H
#define EQUIAFFINE_SRC_DELAUNAY_MISSING_FACETS_H

#include "delaunay/Facet_mesh.h"
#include "delaunay/insert_points.h"

#include <cstddef>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <utility>

namespace equiaffine::internal {

/// Adds the triangle between an edge of a feature and two edges of the border of the mesh. It is no facet where the
/// center of its surface Delaunay ball would lie beyond the end of the surface.
inline void add_missing_facets(const Inserted_points& inserted, Facet_mesh& mesh) {
  auto& surface = mesh.surface;
  std::set<std::pair<std::uint32_t, std::uint32_t>>
      sides; // of triangles at features, from the first vertex to the second
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = t[i], w = t[(i + 1) % 3];
      if (mesh.is_on_feature[v] || mesh.is_on_feature[w]) sides.emplace(v, w);
    }
  std::unordered_map<std::uint32_t, std::uint32_t> next; // along the border
  for (const auto& [v, w] : sides)
    if (!sides.contains({w, v})) next[v] = w;
  const auto close = [&](std::uint32_t v, std::uint32_t w) {
    const auto middle = next.find(v);
    if (middle == next.end()) return;
    const auto last = next.find(middle->second);
    if (last != next.end() && last->second == w) surface.triangles.push_back({middle->second, v, w});
  };
  for (const auto& [v, w] : inserted.feature_edges) {
    if (!mesh.has(v) || !mesh.has(w)) continue;
    const std::uint32_t p = mesh.find(v)->second, q = mesh.find(w)->second;
    if (sides.contains({p, q}) || sides.contains({q, p})) continue;
    close(p, q);
    close(q, p);
  }
  mesh.topology = mesh_topology(surface.triangles, surface.points.size());
}

} // namespace equiaffine::internal

#endif
