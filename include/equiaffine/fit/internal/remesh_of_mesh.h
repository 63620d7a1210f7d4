// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_REMESH_OF_MESH_H
#define EQUIAFFINE_FIT_INTERNAL_REMESH_OF_MESH_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/internal/Whole_remesh_3.h>
#include <equiaffine/fit/internal/feature_angle.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/helpers.h>
#include <boost/graph/graph_traits.hpp>

#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

template <class Parameters>
Remesh_request remesh_request(const Parameters& parameters) {
  const Remesh_request request = {
      get_parameter<Target_edge_length_tag>(parameters, std::optional<double>()),
      feature_angle(parameters),
      get_parameter<Number_of_iterations_tag>(parameters, 3u),
  };
  check_argument(!request.edge_length || (*request.edge_length > 0 && std::isfinite(*request.edge_length)),
                 "the length of the edges of a remesh is a positive number");
  return request;
}

/// Copies a mesh, and marks the edges that are to be kept in the map of Whole_remesh_3.
template <class Kernel, class Mesh, class Parameters>
typename Whole_remesh_3<Kernel>::Mesh copy_to_remesh(const Mesh& mesh, const Parameters& parameters) {
  using Copy = typename Whole_remesh_3<Kernel>::Mesh;
  Copy copy;
  auto is_kept =
      copy.template add_property_map<typename Copy::Edge_index, bool>(Whole_remesh_3<Kernel>::name_of_edges, false)
          .first;
  std::vector<std::pair<typename boost::graph_traits<Mesh>::halfedge_descriptor, typename Copy::Halfedge_index>> pairs;
  CGAL::copy_face_graph(mesh, copy,
                        CGAL::parameters::vertex_point_map(vertex_points(mesh, parameters))
                            .halfedge_to_halfedge_output_iterator(std::back_inserter(pairs)));
  if constexpr (has_parameter<Edge_is_constrained_tag, Parameters>)
    for (const auto& [h, h_of_copy] : pairs)
      is_kept[copy.edge(h_of_copy)] = get(given_parameter<Edge_is_constrained_tag>(parameters), edge(h, mesh));
  return copy;
}

/// Replaces a mesh by its remesh, and gives the vertices their outcomes.
template <class Kernel, class Mesh, class Outcomes, class Parameters>
void replace_by_remesh(Mesh& mesh, Whole_remesh_3<Kernel>& whole_remesh, const Outcomes& outcomes,
                       const Parameters& parameters) {
  using Remesh = typename Whole_remesh_3<Kernel>::Mesh;
  const Remesh& remesh = whole_remesh.mesh();
  using Graph = boost::graph_traits<Mesh>;
  if constexpr (requires { mesh.clear_without_removing_property_maps(); }) mesh.clear_without_removing_property_maps();
  else CGAL::clear(mesh);
  std::vector<std::pair<typename Remesh::Vertex_index, typename Graph::vertex_descriptor>> new_vertices;
  std::vector<std::pair<typename Remesh::Halfedge_index, typename Graph::halfedge_descriptor>> new_halfedges;
  CGAL::copy_face_graph(remesh, mesh,
                        CGAL::parameters::vertex_to_vertex_output_iterator(std::back_inserter(new_vertices))
                            .halfedge_to_halfedge_output_iterator(std::back_inserter(new_halfedges)),
                        CGAL::parameters::vertex_point_map(vertex_points(mesh, parameters)));
  if constexpr (has_parameter<Vertex_outcome_tag, Parameters>)
    for (const auto& [from, to] : new_vertices)
      put(given_parameter<Vertex_outcome_tag>(parameters), to, get(outcomes, from));
  if constexpr (has_parameter<Edge_is_constrained_tag, Parameters>) {
    const auto is_kept = whole_remesh.kept_edges();
    for (const auto& [from, to] : new_halfedges)
      put(given_parameter<Edge_is_constrained_tag>(parameters), edge(to, mesh), is_kept[remesh.edge(from)]);
  }
}

} // namespace equiaffine::internal

#endif
