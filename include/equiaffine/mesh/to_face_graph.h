// SPDX-License-Identifier: GPL-3.0-or-later
// Gives the mesh of a sampler to a CGAL::Surface_mesh, to any other mesh of CGAL, or to containers of the caller.
#ifndef EQUIAFFINE_MESH_TO_FACE_GRAPH_H
#define EQUIAFFINE_MESH_TO_FACE_GRAPH_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/mesh/Isosurface_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/copy_to_graph.h>

#include <CGAL/Surface_mesh.h>

namespace equiaffine {

/// Makes a CGAL::Surface_mesh, with the property map `v:status` (Point_status), from the mesh of a sampler. It has all
/// triangles, in the same order. Vertex i is point i; where the mesh is not a manifold, as a Delaunay mesh of x y z = 0
/// is along the axes, copies of vertices follow, which have the same point and status, so that the parts of the surface
/// that meet there come apart. `surface.points` and `surface.triangles` are the mesh in which they are joined, and can
/// be given to CGAL's functions for polygon soups.
template <class Kernel>
CGAL::Surface_mesh<typename Kernel::Point_3> to_surface_mesh(const Isosurface_3<Kernel>& surface) {
  return internal::surface_mesh_of(surface);
}

/// Adds the same mesh to a model of CGAL's MutableFaceGraph of any kernel with coordinates that are doubles. Vertices
/// and faces are made in their order; a CGAL::Surface_mesh puts the first ones where others were removed.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | writable property map | the mesh's own | from vertices to points |
/// | `vertex_status_map` | writable property map | none | from vertices to Point_status |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
template <class Kernel, Face_graph Graph, internal::Parameter_chain... Parameters>
void to_face_graph(const Isosurface_3<Kernel>& surface, Graph& graph, const Parameters&... given) {
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Vertex_point_tag,
                             internal::Vertex_status_tag, internal::Geom_traits_tag, internal::Verbose_tag>();
  internal::copy_to_graph(surface, graph, internal::joined_parameters(given...));
}

/// Adds the points and the triangles of a mesh to containers of the caller, as CGAL's Isosurfacing_3 does: one of
/// points of any kernel with `push_back`, and one of triangles that are containers with `push_back`, or arrays, of
/// indices. Indices count the points that are there before, too.
template <class Kernel, class Points, class Triangles>
void to_polygon_soup(const Isosurface_3<Kernel>& surface, Points& points, Triangles& triangles) {
  internal::copy_to_soup(surface, points, triangles);
}

} // namespace equiaffine

#endif
