// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_COPY_TO_GRAPH_H
#define EQUIAFFINE_MESH_INTERNAL_COPY_TO_GRAPH_H

#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/mesh/Isosurface_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/internal/points_of_range.h>
#include <equiaffine/mesh/internal/surface_mesh_of.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/property_map.h>
#include <boost/graph/graph_traits.hpp>

#include <type_traits>
#include <vector>

namespace equiaffine::internal {

/// Adds a copy of a mesh to a graph. Returns the copies of its vertices, which are made in their order: that is what
/// CGAL::copy_face_graph does not keep.
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
  static_assert(!std::is_const_v<Graph>, "the mesh that gets the surface is const: give one that can be changed");
  check_coordinates<Point_of_vertices<Graph, Parameters>>();
  auto mesh = surface_mesh_of(surface);
  using Vertex = typename boost::graph_traits<decltype(surface_mesh_of(surface))>::vertex_descriptor;
  const auto copies = add_copy(mesh, graph, vertex_points(graph, parameters));
  if constexpr (has_parameter<Vertex_status_tag, Parameters>) {
    const auto status = mesh.template add_property_map<Vertex, Point_status>("v:status").first; // it is there
    for (const Vertex v : mesh.vertices()) put(given_parameter<Vertex_status_tag>(parameters), copies[v], status[v]);
  }
}

} // namespace equiaffine::internal

#endif
