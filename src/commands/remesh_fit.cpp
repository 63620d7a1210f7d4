// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/remesh_fit.h"

#include "commands/maps_view.h"
#include "source/read_triangle_mesh.h"
#include <equiaffine/Input_error.h>
#include <equiaffine/remesh_on_fit.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

namespace equiaffine {

namespace {

using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh mesh_of_data(const Indexed_triangle_mesh_3<Kernel>& data, const Source_options& options) {
  if (data.triangles.empty())
    throw Input_error("--method remesh: '" + options.text +
                      "' has points without faces; use --method marching-cubes, or give a mesh");
  Polygon_soup soup{data.points, {}};
  for (const auto& triangle : data.triangles) soup.polygons.emplace_back(triangle.begin(), triangle.end());
  return to_triangle_mesh(std::move(soup), options.text);
}

/// The greatest distance of vertices with an outcome, or without it, from the data.
double greatest_distance(const std::vector<double>& distances, const std::vector<double>& outcomes, bool is_on_fit) {
  double greatest = 0;
  for (std::size_t i = 0; i < distances.size(); ++i)
    if ((outcomes[i] == double(Fit_outcome::ON_FIT)) == is_on_fit) greatest = std::max(greatest, distances[i]);
  return greatest;
}

template <class Parameters>
Fit_remesh_report remesh(Mesh& mesh, const Fit_traits& fit, const Parameters& parameters) try {
  return remesh_on_fit<CGAL::Parallel_if_available_tag>(mesh, fit, parameters);
} catch (const std::invalid_argument& error) {
  throw Input_error(std::string("a remesh of the data: ") + error.what());
}

} // namespace

Remeshed_fit remesh_fit(const Source& source, const Source_options& options, const Remesh_options& how) {
  Mesh mesh = mesh_of_data(source.data, options);
  const auto outcome = mesh.add_property_map<Mesh::Vertex_index, Fit_outcome>("v:outcome").first;
  Remeshed_fit result;
  static_cast<Fit_remesh_report&>(result.statistics) = remesh(mesh, *source.fit,
                                                              parameters::vertex_outcome_map(outcome)
                                                                  .target_edge_length(how.edge_length)
                                                                  .feature_angle(options.fit.feature_angle));
  std::unordered_map<Mesh::Vertex_index, std::uint32_t> index;
  for (const auto v : mesh.vertices()) {
    index.emplace(v, std::uint32_t(result.mesh.points.size()));
    result.mesh.points.push_back(mesh.point(v));
    result.outcomes.push_back(double(outcome[v]));
    result.mesh.vertex_status.push_back(outcome[v] == Fit_outcome::ON_FIT ? Point_status::REGULAR
                                                                          : Point_status::UNCONVERGED);
  }
  for (const auto f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    result.mesh.triangles.push_back(
        {index.at(mesh.source(h)), index.at(mesh.target(h)), index.at(mesh.target(mesh.next(h)))});
  }
  const std::vector<double> distances = distances_from(source.data)(result.mesh.points);
  result.statistics.distances_from_data = {greatest_distance(distances, result.outcomes, true),
                                           greatest_distance(distances, result.outcomes, false)};
  if (options.transformation)
    static_cast<Indexed_triangle_mesh_3<Kernel>&>(result.mesh) = moved(result.mesh, *options.transformation);
  return result;
}

} // namespace equiaffine
