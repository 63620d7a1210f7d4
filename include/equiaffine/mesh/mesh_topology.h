// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_MESH_TOPOLOGY_H
#define EQUIAFFINE_MESH_MESH_TOPOLOGY_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/internal/disjoint_sets.h>
#include <equiaffine/mesh/internal/vertex_links.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace equiaffine {

/// The topology of a list of triangles.
struct Mesh_topology {
  /// Every edge is in one triangle, or in two that pass it in opposite directions, and the triangles around every point
  /// form one fan or one closed ring. Points in no triangle and triangles with a repeated index violate this.
  bool is_manifold = true;
  std::size_t edges = 0;                   ///< the number of edges
  std::size_t boundary_edges = 0;          ///< edges in exactly one triangle
  std::size_t components = 0;              ///< connected by points; a point in no triangle counts
  std::ptrdiff_t euler_characteristic = 0; ///< points - edges + triangles
};

/// Computes the topology from the indices alone: points with equal coordinates are different points. Takes nearly
/// linear time and 32 bytes of memory per triangle. \throw std::invalid_argument unless indices are below
/// `number_of_points`
inline Mesh_topology mesh_topology(std::span<const std::array<std::uint32_t, 3>> triangles,
                                   std::size_t number_of_points) {
  const auto is_valid = [&](const auto& t) { return std::max({t[0], t[1], t[2]}) < number_of_points; };
  check_argument(std::all_of(triangles.begin(), triangles.end(), is_valid),
                 "a triangle has the index of no point: give all points of the mesh");
  Mesh_topology topology;
  for_each_vertex_link(triangles, number_of_points, [&](const auto& link) {
    if (!link.is_path_or_circle()) topology.is_manifold = false;
    link.for_each_neighbor([&](std::uint32_t neighbor, std::size_t triangles_at_edge) {
      if (neighbor <= link.vertex()) return; // an edge is counted at its smaller end
      ++topology.edges;
      if (triangles_at_edge == 1) ++topology.boundary_edges;
    });
  });
  topology.components = number_of_points;
  Disjoint_sets<std::uint32_t> connected_points(number_of_points);
  for (const auto& [a, b, c] : triangles) {
    if (connected_points.unite(a, b)) --topology.components;
    if (connected_points.unite(a, c)) --topology.components;
  }
  topology.euler_characteristic =
      std::ptrdiff_t(number_of_points) - std::ptrdiff_t(topology.edges) + std::ptrdiff_t(triangles.size());
  return topology;
}

} // namespace equiaffine

#endif
