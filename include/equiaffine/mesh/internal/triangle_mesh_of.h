// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_TRIANGLE_MESH_OF_H
#define EQUIAFFINE_MESH_INTERNAL_TRIANGLE_MESH_OF_H

#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

namespace equiaffine::internal {

/// The vertices of a graph in their order, and its faces, cut into triangles.
template <class Kernel, class Graph, class Parameters>
Indexed_triangle_mesh_3<Kernel> triangle_mesh_of(const Graph& graph, const Parameters& parameters) {
  const Indexed_polygons mesh = indexed_polygons_of_graph(graph, parameters);
  Indexed_triangle_mesh_3<Kernel> result;
  for (const auto& p : mesh.points) result.points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& polygon : mesh.polygons) add_triangles_of_polygon(mesh.points, polygon, result.triangles);
  return result;
}

} // namespace equiaffine::internal

#endif
