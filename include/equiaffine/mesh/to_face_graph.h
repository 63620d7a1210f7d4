// SPDX-License-Identifier: GPL-3.0-or-later
// Converts the mesh of a sampler to a CGAL::Surface_mesh, to any other mesh of CGAL, or to containers of the caller.
#ifndef EQUIAFFINE_MESH_TO_FACE_GRAPH_H
#define EQUIAFFINE_MESH_TO_FACE_GRAPH_H

#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/mesh_topology.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>
#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <type_traits>
#include <vector>

namespace equiaffine {

/// Converts the mesh of a sampler to a CGAL::Surface_mesh with the property map `v:status` (Point_status). It has all
/// triangles, in the same order. Vertex i is point i. Where the mesh is not a manifold, for example a Delaunay mesh of
/// x y z = 0 along the axes, the parts of the surface that meet there are separated: copies of vertices with the same
/// point and status are appended. In `surface.points` and `surface.triangles` these parts are connected; pass them to
/// CGAL's functions for polygon soups.
template <class Kernel>
CGAL::Surface_mesh<typename Kernel::Point_3> to_surface_mesh(const Isosurface_3<Kernel>& surface) {
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
    const Point_3 p = mesh.point(original); // a copy, since add_vertex() may invalidate references to points
    const Vertex_index copy = mesh.add_vertex(p);
    status[copy] = status[original];
    return copy;
  };
  auto triangles = surface.triangles;
  if (!mesh_topology(triangles, surface.points.size()).is_manifold)
    internal::split_fans(triangles, surface.points.size(), copy_vertex);
  for (const auto& [a, b, c] : triangles)
    // An edge can still be in several triangles if these belong to one fan at both ends of the edge.
    if (mesh.add_face(Vertex_index(a), Vertex_index(b), Vertex_index(c)) == Mesh::null_face())
      mesh.add_face(copy_vertex(a), copy_vertex(b), copy_vertex(c));
  return mesh;
}

} // namespace equiaffine

namespace equiaffine::internal {

/// Adds a copy of a mesh to a graph. Returns the copies of its vertices, which are created in their order, unlike by
/// CGAL::copy_face_graph.
template <class Mesh, class Graph, class Point_map>
auto add_copy(const Mesh& mesh, Graph& graph, const Point_map& points) {
  using Traits = boost::graph_traits<Graph>;
  using Target_kernel = typename CGAL::Kernel_traits<typename boost::property_traits<Point_map>::value_type>::Kernel;
  std::vector<typename Traits::vertex_descriptor> copies;
  for (const auto v : mesh.vertices()) {
    copies.push_back(add_vertex(graph));
    put(points, copies.back(), convert_point<Target_kernel>(mesh.point(v)));
  }
  std::vector<typename Traits::halfedge_descriptor> halfedges(mesh.num_halfedges());
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    halfedges[h] = halfedge(add_edge(graph), graph);
    halfedges[mesh.opposite(h)] = opposite(halfedges[h], graph);
  }
  for (const auto h : mesh.halfedges()) {
    set_target(halfedges[h], copies[mesh.target(h)], graph);
    set_next(halfedges[h], halfedges[mesh.next(h)], graph);
    if (mesh.is_border(h)) set_face(halfedges[h], Traits::null_face(), graph);
  }
  for (const auto f : mesh.faces()) {
    const auto copy = add_face(graph);
    set_halfedge(copy, halfedges[mesh.halfedge(f)], graph);
    for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) set_face(halfedges[h], copy, graph);
  }
  for (const auto v : mesh.vertices())
    if (!mesh.is_isolated(v)) set_halfedge(copies[v], halfedges[mesh.halfedge(v)], graph);
  return copies;
}

template <class Kernel, class Graph, class Parameters>
void copy_to_graph(const Isosurface_3<Kernel>& surface, Graph& graph, const Parameters& parameters) {
  static_assert(!std::is_const_v<Graph>, "the output mesh is const: pass a mesh that can be modified");
  check_coordinates<Point_of_vertices<Graph, Parameters>>();
  auto mesh = to_surface_mesh(surface);
  using Vertex = typename boost::graph_traits<decltype(to_surface_mesh(surface))>::vertex_descriptor;
  const auto copies = add_copy(mesh, graph, vertex_points(graph, parameters));
  if constexpr (has_parameter<Vertex_status_tag, Parameters>) {
    const auto status = mesh.template add_property_map<Vertex, Point_status>("v:status").first; // exists already
    for (const Vertex v : mesh.vertices()) put(given_parameter<Vertex_status_tag>(parameters), copies[v], status[v]);
  }
}

/// Returns the statistics of a sampler, without its mesh.
template <class Surface>
Surface without_mesh(Surface surface) {
  surface.points.clear();
  surface.triangles.clear();
  return surface;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Adds the same mesh to a model of CGAL's MutableFaceGraph, for any kernel whose coordinates are doubles. Vertices and
/// faces are created in their order; a CGAL::Surface_mesh first reuses the places of removed ones.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | writable property map | the mesh's own | from vertices to points |
/// | `vertex_status_map` | writable property map | none | from vertices to Point_status |
///
/// `geom_traits` and `verbose` are accepted for compatibility with CGAL, and ignored.
template <class Kernel, Face_graph Graph, internal::Parameter_chain... Parameters>
void to_face_graph(const Isosurface_3<Kernel>& surface, Graph& graph, const Parameters&... given) {
  internal::check_parameters<internal::Joined_parameters<Parameters...>, internal::Vertex_point_tag,
                             internal::Vertex_status_tag, internal::Geom_traits_tag, internal::Verbose_tag>();
  internal::copy_to_graph(surface, graph, internal::joined_parameters(given...));
}

/// Adds the points and triangles of a mesh to containers of the caller, like CGAL's Isosurfacing_3. `points` must have
/// `push_back` and points of any kernel; `triangles` must have `push_back`, and its elements are arrays of indices or
/// containers with `push_back`. Indices take points that are already in the container into account.
template <class Kernel, class Points, class Triangles>
void to_polygon_soup(const Isosurface_3<Kernel>& surface, Points& points, Triangles& triangles) {
  using Point = typename Points::value_type;
  using Triangle = typename Triangles::value_type;
  check_coordinates<Point>();
  const std::size_t before = points.size();
  for (const auto& p : surface.points)
    points.push_back(Point(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())));
  for (const auto& corners : surface.triangles) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      using Index = std::decay_t<decltype(triangle[k])>;
      const auto index = static_cast<Index>(before + corners[k]);
      if constexpr (requires { triangle.push_back(index); }) triangle.push_back(index);
      else triangle[k] = index;
    }
    triangles.push_back(triangle);
  }
}

} // namespace equiaffine

#endif
