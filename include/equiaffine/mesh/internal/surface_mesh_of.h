// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_SURFACE_MESH_OF_H
#define EQUIAFFINE_MESH_INTERNAL_SURFACE_MESH_OF_H

#include <equiaffine/mesh/Isosurface_3.h>
#include <equiaffine/mesh/internal/split_fans.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Surface_mesh.h>

#include <cstddef>

namespace equiaffine::internal {

/// The function of `to_surface_mesh`.
template <class Kernel>
CGAL::Surface_mesh<typename Kernel::Point_3> surface_mesh_of(const Isosurface_3<Kernel>& surface) {
  using Point_3 = typename Kernel::Point_3;
  using Mesh = CGAL::Surface_mesh<Point_3>;
  using Vertex_index = typename Mesh::Vertex_index;
  using Size = typename Vertex_index::size_type;
  Mesh mesh;
  mesh.reserve(Size(surface.points.size()), Size(surface.triangles.size() * 3 / 2), Size(surface.triangles.size()));
  auto status = mesh.template add_property_map<Vertex_index, Point_status>("v:status", Point_status::REGULAR).first;
  for (std::size_t i = 0; i < surface.points.size(); ++i)
    status[mesh.add_vertex(surface.points[i])] = surface.vertex_status[i];
  const auto copy_vertex = [&](std::size_t v) {
    const Vertex_index original{Size(v)};
    const Point_3 p = mesh.point(original); // a copy, since the new vertex may move the points
    const Vertex_index copy = mesh.add_vertex(p);
    status[copy] = status[original];
    return copy;
  };
  auto triangles = surface.triangles;
  if (!mesh_topology(triangles, surface.points.size()).is_manifold)
    split_fans(triangles, surface.points.size(), copy_vertex);
  for (const auto& [a, b, c] : triangles)
    // An edge may still be in several triangles if these belong to one fan at both of its ends.
    if (mesh.add_face(Vertex_index(a), Vertex_index(b), Vertex_index(c)) == Mesh::null_face())
      mesh.add_face(copy_vertex(a), copy_vertex(b), copy_vertex(c));
  return mesh;
}

/// Returns the facts that a sampler found beside its mesh.
template <class Surface>
Surface without_mesh(Surface surface) {
  surface.points.clear();
  surface.triangles.clear();
  return surface;
}

} // namespace equiaffine::internal

#endif
