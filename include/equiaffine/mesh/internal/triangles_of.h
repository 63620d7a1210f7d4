// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_TRIANGLES_OF_H
#define EQUIAFFINE_MESH_INTERNAL_TRIANGLES_OF_H

#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/Triangles_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace equiaffine::internal {

inline Triangles_3 triangles_of(Indexed_polygons mesh) {
  Triangles_3 result;
  for (const auto& polygon : mesh.polygons) add_triangles_of_polygon(mesh.points, polygon, result.triangles);
  result.points = std::move(mesh.points);
  return result;
}

template <class Graph, class Parameters>
Triangles_3 triangles_of_graph(const Graph& graph, const Parameters& parameters) {
  return triangles_of(indexed_polygons_of_graph(graph, parameters));
}

/// Triangles that share a corner are to know it, so that equal points become one.
template <class Points, class Polygons>
Triangles_3 triangles_of_soup(const Points& points, const Polygons& polygons) {
  Triangles_3 mesh = triangles_of(indexed_polygons_of_soup(points, polygons));
  const std::vector<std::uint32_t> first = first_of_equal(mesh.points);
  for (auto& triangle : mesh.triangles)
    for (auto& corner : triangle) corner = first[corner];
  return mesh;
}

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
