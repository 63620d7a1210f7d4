// SPDX-License-Identifier: GPL-3.0-or-later
#include "attributes/fit_columns.h"

#include "attributes/error_columns.h"
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/io/trust.h>

#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <cmath>
#include <cstddef>
#include <utility>

namespace equiaffine {

namespace {

using Structures = std::vector<Fitted_structure_3<double>>;
using Point_with_normal = std::pair<Kernel::Point_3, Kernel::Vector_3>;

/// The points with the normals in the columns nx, ny, nz. It is empty unless every point has one.
std::vector<Point_with_normal> points_with_normals(const Annotated_mesh_3<Kernel>& mesh) {
  const auto *x = find_column(mesh.attributes, "nx"), *y = find_column(mesh.attributes, "ny"),
             *z = find_column(mesh.attributes, "nz");
  if (!x || !y || !z) return {};
  std::vector<Point_with_normal> result;
  for (std::size_t i = 0; i < mesh.mesh.points.size(); ++i) {
    const double length = std::hypot(x->values[i], y->values[i], z->values[i]);
    if (!std::isnormal(length)) return {};
    result.emplace_back(mesh.mesh.points[i],
                        Kernel::Vector_3(x->values[i] / length, y->values[i] / length, z->values[i] / length));
  }
  return result;
}

template <class Parameters>
Structures fit_points(const Annotated_mesh_3<Kernel>& mesh, const Parameters& parameters) {
  const auto with_normals = points_with_normals(mesh);
  if (with_normals.empty()) return fitted_structures<CGAL::Parallel_if_available_tag>(mesh.mesh.points, parameters);
  return fitted_structures<CGAL::Parallel_if_available_tag>(
      with_normals, parameters.point_map(CGAL::First_of_pair_property_map<Point_with_normal>())
                        .normal_map(CGAL::Second_of_pair_property_map<Point_with_normal>()));
}

double estimate(const Fitted_structure_3<double>& s, const std::string& name) {
  if (name == error_attributes[0]) return s.error.gaussian_curvature;
  if (name == error_attributes[1]) return s.error.mean_curvature;
  return name == noise_attributes[0] ? s.noise.gaussian_curvature : s.noise.mean_curvature;
}

} // namespace

Structures fit_vertices(const Annotated_mesh_3<Kernel>& mesh, const Fit_options& options,
                        Orientation_of_level_set orientation) {
  const auto parameters =
      parameters::scale(options.scale).noise(options.noise).degree(options.degree).orientation(orientation);
  if (mesh.mesh.triangles.empty()) return fit_points(mesh, parameters);
  return fitted_structures<CGAL::Parallel_if_available_tag>(mesh.mesh.points, mesh.mesh.triangles, parameters);
}

Vertex_attributes attributes_of(std::span<const Fitted_structure_3<double>> structures,
                                const Attribute_selection& selection) {
  Vertex_attributes result;
  for (const Attribute& attribute : selection.columns) {
    auto& column = result.columns.emplace_back(Vertex_attributes::Column{std::string(attribute.name), {}});
    for (const auto& s : structures) column.values.push_back(attribute.get(s.structure));
  }
  if (!selection.has_status) return result;
  result.status.emplace();
  for (const auto& s : structures) result.status->push_back(s.structure.status);
  return result;
}

void add_estimates(std::span<const Fitted_structure_3<double>> structures, const std::vector<std::string>& names,
                   Vertex_attributes& attributes) {
  for (const std::string& name : names) {
    if (find_column(attributes, name)) continue;
    auto& column = attributes.columns.emplace_back(Vertex_attributes::Column{name, {}});
    for (const auto& s : structures) column.values.push_back(estimate(s, name));
  }
}

} // namespace equiaffine
