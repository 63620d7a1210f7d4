// SPDX-License-Identifier: GPL-3.0-or-later
// The commands `register` and `symmetries`.
#include "commands/Surface_to_register.h"
#include "commands/commands.h"
#include "commands/find_maps.h"
#include "output/Outputs.h"
#include "output/displays.h"
#include "output/maps.h"
#include "output/maps_display.h"
#include "picture/draw_surface.h"
#include "system/files.h"
#include "system/front_end.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/registration/internal/Surface_to_register.h>
#include <equiaffine/registration/register_surfaces.h>

#include <array>
#include <string>

namespace equiaffine {

namespace {

using Map = CGAL::Aff_transformation_3<Kernel>;

Outputs outputs_of_maps(const Request& options) {
  check_maps_output(options.output);
  check_display_outputs(options.display);
  if (options.moved) check_surface_output(*options.moved);
  Outputs outputs(options.output, options.display);
  outputs.add(Output_kind::MOVED, options.moved);
  return outputs;
}

/// The distances of points from the moved source (unmoved if there is no map) and from the target.
std::array<Distances_of_points, 2> distances_from_surfaces(const internal::Registration_of_surfaces& found) {
  const auto& [source, target, registration] = found;
  const Map map = registration.found() ? registration.best().map : Map(CGAL::IDENTITY);
  if (registration.is_by_triangles)
    return {distances_from(internal::moved_mesh(source.mesh, map)), distances_from(target.mesh)};
  return {distances_from(source.refined(), map.inverse()), distances_from(target.refined())};
}

} // namespace

void run_register(const Request& options, std::ostream& out, Progress& progress) {
  Outputs outputs = outputs_of_maps(options);
  const bool is_shown = options.display.shows_something();
  const internal::Registration_of_surfaces found = find_map(options, progress);
  const Registration_report report = report_of(options, found);
  progress.begin("writing");
  if (!report.registration.found()) outputs.remove(Output_kind::MOVED);
  outputs[Output_kind::RESULT].stream() << to_JSON(report);
  if (is_shown) {
    const auto [mesh, attributes] =
        registered_surfaces(found.source, found.target, distances_from_surfaces(found), report.registration);
    const Display_request display = display_of(report, options.display);
    write_displays(
        outputs, mesh, attributes, display,
        {page_title(options.output, "Registration"), description_of(report, display), notes_of(report, display)});
  }
  if (Output_file* const file = outputs.find(Output_kind::MOVED)) {
    const auto [mesh, attributes] =
        moved_source(found.source, distances_from_surfaces(found)[1], report.registration.best().map);
    write_surface(*file, mesh, attributes);
    warn_of_lost_points(file->path(), mesh.points, progress);
  }
  progress.end();
  outputs.commit();
  if (outputs.use_standard_output()) return;
  out << summary(report);
  outputs.report(out);
}

void run_symmetries(const Request& options, std::ostream& out, Progress& progress) {
  Outputs outputs = outputs_of_maps(options);
  Found_symmetries found = find_symmetries(options, progress);
  const Symmetries_report report = report_of(options, found);
  progress.begin("writing");
  outputs[Output_kind::RESULT].stream() << to_JSON(report);
  if (options.display.shows_something()) {
    const auto [mesh, attributes] = found.shown();
    if (!options.display.arrows.empty() && !vector_columns(attributes, options.display.arrows))
      throw Input_error(option_text("arrows") + ": there is no vector '" + options.display.arrows +
                        "'; continuous symmetries have generator1, generator2 and so on, one per dimension");
    const Display_request display = display_of(report, options.display);
    write_displays(
        outputs, mesh, attributes, display,
        {page_title(options.output, "Symmetries"), description_of(report, display), notes_of(report, display)});
  }
  progress.end();
  outputs.commit();
  if (outputs.use_standard_output()) return;
  out << summary(report);
  outputs.report(out);
}

} // namespace equiaffine
