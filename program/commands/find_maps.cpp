// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/find_maps.h"

#include "commands/Surface_to_register.h"
#include "output/maps.h"
#include "request/Request.h"
#include "source/read_mesh.h"
#include "source/source.h"
#include "system/files.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/registration/affine_symmetries.h>
#include <equiaffine/registration/internal/Surface_to_register.h>
#include <equiaffine/registration/register_surfaces.h>

#include <CGAL/tags.h>

#include <cmath>
#include <string>
#include <utility>

namespace equiaffine {

internal::Registration_of_surfaces find_map(const Request& options, Progress& progress) {
  const bool is_shown = options.display.shows_something();
  auto source = make_surface_of_any_scale(options.source, is_shown, progress);
  auto target = make_surface_of_any_scale(options.target, is_shown, progress);
  progress.begin("looking for the map");
  return internal::registration_of_surfaces(runs_in_threads<CGAL::Parallel_if_available_tag>(), std::move(source),
                                            std::move(target), options.registration);
}

Registration_report report_of(const Request& options, const internal::Registration_of_surfaces& found) {
  return {describe(options.source), describe(options.target), found.result, options.lists_maps};
}

namespace {

/// The mesh of the source's file.
Indexed_triangle_mesh_3<Kernel> read_triangles(const Source_options& source, Progress& progress) {
  progress.begin("reading the mesh");
  Indexed_triangle_mesh_3<Kernel> mesh = read_vertices(source).mesh;
  if (source.transformation)
    for (Kernel::Point_3& p : mesh.points) p = (*source.transformation)(p);
  return mesh;
}

} // namespace

std::string Found_symmetries::name(const Source_options& source) const {
  return level_set ? describe(source) : "the mesh '" + name_of_file(source.text) + "'";
}

Annotated_mesh_3<Kernel> Found_symmetries::shown() const {
  return surface_with_symmetries(mesh, symmetries,
                                 level_set ? distances_from(level_set->function) : distances_from(mesh));
}

Found_symmetries find_symmetries(const Request& options, Progress& progress) {
  Found_symmetries found;
  Source_options source = options.source;
  read_data_once(source, progress);
  if (is_mesh_itself(source)) found.mesh = read_triangles(source, progress);
  const bool is_shown = source.kind == Source_kind::FIT || options.display.shows_something();
  const auto make_level_set = [&] {
    auto level_set = make_surface_to_register(source, is_shown, progress);
    progress.begin("looking for symmetries");
    return level_set;
  };
  progress.begin("looking for symmetries");
  auto [result, level_set] =
      internal::symmetries_of_surface(runs_in_threads<CGAL::Parallel_if_available_tag>(), found.mesh,
                                      origin_of_source(source), make_level_set, options.symmetries);
  found.symmetries = std::move(result);
  found.level_set = std::move(level_set);
  if (found.level_set) found.mesh = found.level_set->shown();
  return found;
}

Symmetries_report report_of(const Request& options, const Found_symmetries& found) {
  Symmetries_report report = {found.name(options.source), found.symmetries, options.symmetries.complete,
                              keeps_angles(found.symmetries.kind) && !keeps_angles(options.symmetries.kind)};
  if (!std::isfinite(report.symmetries.maps.front().rms))
    throw Input_error("cannot find symmetries of " + report.source +
                      ": the fit has no surface near any of its points; give more points");
  return report;
}

} // namespace equiaffine
