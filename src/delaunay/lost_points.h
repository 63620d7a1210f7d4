// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DELAUNAY_LOST_POINTS_H
#define EQUIAFFINE_SRC_DELAUNAY_LOST_POINTS_H

#include "delaunay/Facet_mesh.h"
#include "delaunay/insert_points.h"
#include <equiaffine/mesh/internal/vertex_links.h>

#include <CGAL/Kernel/global_functions_3.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

using Lost_points = std::vector<Surface_domain_3::Point_3>;

/// Appends the points where the mesh is not a manifold, since parts of the surface, or features, are nearer to each
/// other than facets are large.
inline void append_singular_vertices(const Facet_mesh& mesh, Lost_points& lost) {
  const auto& surface = mesh.surface;
  for_each_vertex_link(surface.triangles, surface.points.size(), [&](const auto& link) {
    const auto& p = surface.points[link.vertex()];
    if (!link.is_path_or_circle()) lost.emplace_back(p.x(), p.y(), p.z());
  });
}

/// Appends the vertices on the surface that are in no triangle.
inline void append_isolated_vertices(const Surface_triangulation& triangulation, const Facet_mesh& mesh,
                                     Lost_points& lost) {
  for (const auto vertex : triangulation.finite_vertex_handles())
    if (vertex->in_dimension() < 3 && !mesh.has(vertex)) lost.push_back(triangulation.point(vertex).point());
}

/// Appends the midpoints between neighbors on a feature that no edge of the mesh joins. A neighbor in no triangle is an
/// isolated vertex.
inline void append_missing_feature_edges(const Inserted_points& inserted, const Facet_mesh& mesh, Lost_points& lost) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges; // between points on features, the smaller number first
  for (const auto& t : mesh.surface.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = t[i], w = t[(i + 1) % 3];
      if (mesh.is_on_feature[v] && mesh.is_on_feature[w]) edges.insert(std::minmax(v, w));
    }
  for (const auto& [v, w] : inserted.feature_edges)
    if (mesh.has(v) && mesh.has(w) && !edges.contains(std::minmax(mesh.find(v)->second, mesh.find(w)->second)))
      lost.push_back(CGAL::midpoint(v->point().point(), w->point().point()));
}

} // namespace equiaffine::internal

#endif
