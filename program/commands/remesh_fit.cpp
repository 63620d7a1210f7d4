// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/Surface_to_register.h"
#include "commands/make_surface.h"
#include "source/read_mesh.h"
#include "system/front_end.h"
#include <equiaffine/attributes/remesh_by_fit.h>
#include <equiaffine/base/Input_error.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Outcomes = Mesh::Property_map<Mesh::Vertex_index, Fit_outcome>;

Mesh mesh_of_data(const Indexed_triangle_mesh_3<Kernel>& data, const Source_options& options) {
  if (data.triangles.empty())
    throw Input_error(option_text("method", "remesh") + ": '" + options.text + "' has no faces; use " +
                      option_text("method", "marching-cubes") + ", or give a mesh");
  return to_surface(data, options.text);
}

/// The maximum distance from the data of the vertices that are on the fit, or of the others.
double greatest_distance(const std::vector<double>& distances, const std::vector<double>& outcomes, bool is_on_fit) {
  double greatest = 0;
  for (std::size_t i = 0; i < distances.size(); ++i)
    if ((outcomes[i] == double(Fit_outcome::ON_FIT)) == is_on_fit) greatest = std::max(greatest, distances[i]);
  return greatest;
}

/// Remeshes the data of a source. If a smaller scale suits the shape better, the source becomes the fit at that scale.
Fit_remesh_report remesh(Mesh& mesh, const Outcomes& outcomes, Source& source, const Source_options& options,
                         Remesh_options how, Progress& progress) try {
  how.feature_angle = options.fit.feature_angle;
  const auto refit = [&](const Fit_options& at_scale) {
    Source_options with_scale = options;
    with_scale.fit = at_scale;
    const Source smaller = refitted(source, with_scale, progress);
    progress.begin("remeshing");
    return smaller.fit->fit();
  };
  Fit_traits::Fit fit = source.fit->fit();
  const auto report = internal::remesh_on_best_fit<CGAL::Parallel_if_available_tag>(
      mesh, fit, options.fit, source.data.points, refit, how, parameters::vertex_outcome_map(outcomes));
  if (fit.scale() != source.fit->scale())
    source = source_of_fit(Fit_traits(std::move(fit)), std::move(source.data), options);
  return report;
} catch (const Input_error& error) {
  throw Input_error("cannot remesh the data: " + error.sentence());
}

} // namespace

Remeshed_fit remesh_fit(Source& source, const Source_options& options, const Remesh_options& how, Progress& progress) {
  progress.begin("remeshing");
  Mesh mesh = mesh_of_data(source.data, options);
  const Outcomes outcomes = mesh.add_property_map<Mesh::Vertex_index, Fit_outcome>("v:outcome").first;
  Remeshed_fit result;
  static_cast<Fit_remesh_report&>(result.statistics) = remesh(mesh, outcomes, source, options, how, progress);
  std::unordered_map<Mesh::Vertex_index, std::uint32_t> index;
  for (const auto v : mesh.vertices()) {
    index.emplace(v, std::uint32_t(result.mesh.points.size()));
    result.mesh.points.push_back(mesh.point(v));
    result.outcomes.push_back(double(outcomes[v]));
    result.mesh.vertex_status.push_back(outcomes[v] == Fit_outcome::ON_FIT ? Point_status::REGULAR
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
    static_cast<Indexed_triangle_mesh_3<Kernel>&>(result.mesh) =
        internal::moved_mesh(result.mesh, *options.transformation);
  return result;
}

} // namespace equiaffine
