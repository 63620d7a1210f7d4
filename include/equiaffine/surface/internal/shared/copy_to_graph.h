// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_SHARED_COPY_TO_GRAPH_H
#define EQUIAFFINE_SURFACE_INTERNAL_SHARED_COPY_TO_GRAPH_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/surface/Isosurface_3.h>
#include <equiaffine/surface/internal/shared/indexed_polygons.h>
#include <equiaffine/surface/internal/shared/points_of_range.h>
#include <equiaffine/surface/internal/shared/surface_mesh_of.h>

#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/property_map.h>

#include <iterator>
#include <utility>
#include <vector>

namespace equiaffine::internal {

template <class Kernel, class Graph, class Parameters>
void copy_to_graph(const Isosurface_3<Kernel>& surface, Graph& graph, const Parameters& parameters) {
  static_assert(!std::is_const_v<Graph>, "the mesh that gets the surface is const: give one that can be changed");
  using Target_vertex = typename boost::graph_traits<Graph>::vertex_descriptor;
  auto mesh = surface_mesh_of(surface);
  using Vertex = typename boost::graph_traits<decltype(surface_mesh_of(surface))>::vertex_descriptor;
  const auto point_map = vertex_points(graph, parameters);
  check_coordinates<Point_of_vertices<Graph, Parameters>>();
  std::vector<std::pair<Vertex, Target_vertex>> copies;
  CGAL::copy_face_graph(mesh, graph, CGAL::parameters::vertex_to_vertex_output_iterator(std::back_inserter(copies)),
                        CGAL::parameters::vertex_point_map(point_map));
  if constexpr (has_parameter<Vertex_status_tag, Parameters>) {
    const auto status = mesh.template add_property_map<Vertex, Point_status>("v:status").first; // it is there
    for (const auto& [from, to] : copies) put(given_parameter<Vertex_status_tag>(parameters), to, status[from]);
  }
}

} // namespace equiaffine::internal

#endif
