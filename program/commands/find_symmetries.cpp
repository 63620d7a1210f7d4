// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/find_symmetries.h"

#include "commands/maps_view.h"
#include "commands/what_to_try.h"
#include "source/read_vertices.h"
#include "source/source.h"
#include "system/name_of_file.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/registration/affine_symmetries.h>

#include <CGAL/tags.h>

#include <cmath>
#include <optional>

namespace equiaffine {

namespace {

/// How far symmetries may move points from the surface, a part of its size: splines and fits know the surface to within
/// their errors only.
std::optional<double> tolerance_of(const Symmetries_options& options) {
  const Source_options& source = options.surface.source;
  if (options.tolerance) return options.tolerance;
  if (source.kind == Source_kind::FIT) return 1e-3;
  if (source.derivatives == Derivatives::SPLINE) return 1e-5;
  return std::nullopt;
}

/// The triangles of the file that the source names, none if it has no faces.
Indexed_triangle_mesh_3<Kernel> read_triangles(const Source_options& source, Progress& progress) {
  progress.begin("reading the mesh");
  Indexed_triangle_mesh_3<Kernel> mesh = read_vertices(source).mesh;
  if (source.transformation)
    for (Kernel::Point_3& p : mesh.points) p = (*source.transformation)(p);
  return mesh;
}

auto parameters_of(const Symmetries_options& options) {
  return parameters::map_kind(options.maps.kind).reflections(options.maps.allows_reflections);
}

Symmetries symmetries_of_function(const Surface_to_register& surface, const Symmetries_options& options) {
  const auto parameters = parameters_of(options).complete(options.is_complete);
  const auto tolerance = tolerance_of(options);
  const auto& points = surface.mesh.points;
  if (!tolerance) return affine_symmetries<CGAL::Parallel_if_available_tag>(surface.function, points, parameters);
  return affine_symmetries<CGAL::Parallel_if_available_tag>(surface.function, points, parameters.tolerance(*tolerance));
}

Symmetries symmetries_of_mesh(const Indexed_triangle_mesh_3<Kernel>& mesh, const Symmetries_options& options) {
  const auto parameters = parameters_of(options);
  if (!options.tolerance)
    return affine_symmetries<CGAL::Parallel_if_available_tag>(mesh.points, mesh.triangles, parameters);
  return affine_symmetries<CGAL::Parallel_if_available_tag>(mesh.points, mesh.triangles,
                                                            parameters.tolerance(*options.tolerance));
}

} // namespace

std::string Found_symmetries::name(const Source_options& source) const {
  return level_set ? describe(source) : "the mesh '" + name_of_file(source.text) + "'";
}

Annotated_mesh_3<Kernel> Found_symmetries::shown() const {
  return surface_with_symmetries(mesh, symmetries,
                                 level_set ? distances_from(level_set->function) : distances_from(mesh));
}

Found_symmetries find_symmetries(const Symmetries_options& options, Progress& progress) {
  Found_symmetries found;
  const Source_options& source = options.surface.source;
  if (is_mesh_itself(options.surface)) {
    found.mesh = read_triangles(source, progress);
    if (!found.mesh.triangles.empty()) {
      progress.begin("looking for symmetries");
      found.symmetries = symmetries_of_mesh(found.mesh, options);
      if (!is_undecided(found.symmetries) || keeps_angles(options.maps.kind) || !found.symmetries.levels.empty())
        return found;
    }
  }
  const bool is_fit = source.kind == Source_kind::FIT;
  found.level_set = make_surface_to_register(options.surface, is_fit || options.display.shows_something(), progress);
  const Surface_to_register& surface = *found.level_set;
  const bool has_points_only = is_fit && surface.mesh.triangles.empty() && !surface.extracted.triangles.empty();
  progress.begin("looking for symmetries");
  const Symmetries by_function =
      has_points_only ? symmetries_of_mesh(surface.shown(), options) : symmetries_of_function(surface, options);
  if (!is_undecided(by_function) || found.mesh.triangles.empty()) found.symmetries = by_function;
  found.mesh = surface.shown();
  return found;
}

Symmetries_report report_of(const Symmetries_options& options, const Found_symmetries& found) {
  Symmetries_report report = {found.name(options.surface.source),
                              found.symmetries,
                              options.is_complete,
                              keeps_angles(found.symmetries.kind) && !keeps_angles(options.maps.kind),
                              {}};
  if (!std::isfinite(report.symmetries.maps.front().rms))
    throw Input_error("nothing is known of the symmetries of " + report.source +
                      ": it has a surface beside none of its points; give more points");
  if (is_undecided(report.symmetries) || report.symmetries.order() == 1U)
    report.advice = what_to_try(options, report.symmetries);
  return report;
}

} // namespace equiaffine
