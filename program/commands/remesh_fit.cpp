// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/Surface_to_register.h"
#include "commands/make_surface.h"
#include "source/read_mesh.h"
#include <equiaffine/attributes/internal/error_table.h>
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/fit/Fitted_function_traits_3.h>
#include <equiaffine/fit/remesh_on_fit.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh mesh_of_data(const Indexed_triangle_mesh_3<Kernel>& data, const Source_options& options) {
  if (data.triangles.empty())
    throw Input_error("--method remesh: '" + options.text +
                      "' has points without faces; use --method marching-cubes, or give a mesh");
  return to_surface(data, options.text);
}

/// The greatest distance of vertices with an outcome, or without it, from the data.
double greatest_distance(const std::vector<double>& distances, const std::vector<double>& outcomes, bool is_on_fit) {
  double greatest = 0;
  for (std::size_t i = 0; i < distances.size(); ++i)
    if ((outcomes[i] == double(Fit_outcome::ON_FIT)) == is_on_fit) greatest = std::max(greatest, distances[i]);
  return greatest;
}

template <class Parameters>
Fit_remesh_report remesh(Mesh& mesh, const Fit_traits::Fit& fit, const Parameters& parameters) try {
  return remesh_on_fit<CGAL::Parallel_if_available_tag>(mesh, fit, parameters);
} catch (const std::invalid_argument& error) {
  throw Input_error(std::string("a remesh of the data: ") + error.what());
}

/// The data of a fit, remeshed and moved onto it.
Remeshed_fit remeshed(const Source& source, const Source_options& options, const Remesh_options& how) {
  Mesh mesh = mesh_of_data(source.data, options);
  const auto outcome = mesh.add_property_map<Mesh::Vertex_index, Fit_outcome>("v:outcome").first;
  Remeshed_fit result;
  static_cast<Fit_remesh_report&>(result.statistics) = remesh(mesh, source.fit->fit(),
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

/// The part of the vertices of a remesh that are neither on the fit nor on creases.
double part_beside_fit(const Remesh_statistics& remesh) {
  const std::size_t kept = remesh.number_on_fit() + remesh.number_of[std::size_t(Fit_outcome::ON_FEATURE)];
  return 1 - double(kept) / double(remesh.number_of_vertices());
}

/// The parts of some vertices of the data at which a fit knows the affine area density, of order 2, and the affine
/// Gaussian curvature, of order 4, to a half of their sizes.
std::array<double, 2> parts_known(const Source& source) {
  const std::vector<std::size_t> vertices = random_subset(source.data.points.size(), 1000, 1);
  std::array<double, 2> parts = {};
  for (const std::size_t v : vertices) {
    const auto fitted = source.fit->structure(source.data.points[v]);
    for (const auto& row : error_table<double>) {
      if (!row.is_known(fitted.structure, fitted.error, 0.5)) continue;
      parts[0] += double(row.attribute == "affine_area_density") / double(vertices.size());
      parts[1] += double(row.attribute == "affine_gaussian_curvature") / double(vertices.size());
    }
  }
  return parts;
}

} // namespace

Remeshed_fit remesh_fit(Source& source, Source_options options, const Remesh_options& how, Progress& progress) {
  constexpr double enough = 0.05, least_gain = 1. / 3, greatest_loss = 0.1;
  constexpr int most_tries = 4;
  const bool is_free = !options.fit.scale;
  progress.begin("remeshing");
  Remeshed_fit best = remeshed(source, options, how);
  double last_part = part_beside_fit(best.statistics);
  if (!is_free || !source.fit->scale() || !(best.statistics.edge_length > 0) || last_part < enough) return best;
  double scale = *source.fit->scale();
  const auto known = parts_known(source);
  for (int n = 0; n < most_tries && part_beside_fit(best.statistics) >= enough; ++n) {
    options.fit.scale = scale /= std::numbers::sqrt2;
    try {
      Source smaller = refitted(source, options, progress);
      const auto still_known = parts_known(smaller);
      if (std::max(known[0] - still_known[0], known[1] - still_known[1]) > greatest_loss) break;
      progress.begin("remeshing");
      Remeshed_fit other = remeshed(smaller, options, how);
      const double part = part_beside_fit(other.statistics);
      if (part >= last_part) break;
      last_part = part;
      if (part > (1 - least_gain) * part_beside_fit(best.statistics)) continue;
      source = std::move(smaller);
      best = std::move(other);
    } catch (const Input_error&) {
      break; // too few points are within that scale
    }
  }
  return best;
}

} // namespace equiaffine
