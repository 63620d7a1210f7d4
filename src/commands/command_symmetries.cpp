// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/Surface_to_register.h"
#include "commands/commands.h"
#include "commands/maps_view.h"
#include "commands/what_to_try.h"
#include "output/maps.h"
#include "output/maps_display.h"
#include "output/surface_output.h"
#include "picture/draw_surface.h"
#include "source/source.h"
#include "system/atomic_file.h"
#include <equiaffine/Input_error.h>
#include <equiaffine/affine_symmetries.h>

#include <CGAL/tags.h>

#include <cmath>
#include <string>
#include <vector>

namespace equiaffine {

namespace {

/// How far symmetries may move points from the surface, beside its size: formulas are exact, and splines and fits know
/// the surface to within their errors only.
double default_tolerance(const Source_options& source) {
  if (source.kind == Source_kind::FIT) return 1e-3;
  return source.derivatives == Derivatives::SPLINE ? 1e-5 : 1e-8;
}

/// The output files of the command. The constructor throws if one of them cannot be written.
struct Outputs {
  explicit Outputs(const Symmetries_options& options) {
    check_maps_output(options.output);
    check_display_outputs(options.display);
    files.emplace_back(options.output);
    for (const auto& output : {options.display.html, options.display.png})
      if (output) files.emplace_back(*output);
  }

  std::vector<Output_file> files; // the maps, then those of page and picture that were asked for
};

} // namespace

void run_symmetries(const Symmetries_options& options, std::ostream& out, Progress& progress) {
  Outputs outputs(options);
  const bool is_shown = options.display.shows_something();
  const Surface_to_register surface = make_surface_to_register(options.surface, is_shown, progress);
  progress.begin("looking for symmetries");
  const double tolerance = options.tolerance.value_or(default_tolerance(options.surface.source));
  const auto parameters =
      parameters::map_kind(options.maps.kind).reflections(options.maps.allows_reflections).tolerance(tolerance);
  Symmetries_report report = {
      describe(options.surface.source),
      affine_symmetries<CGAL::Parallel_if_available_tag>(surface.function, surface.mesh.points, parameters),
      {}};
  if (!std::isfinite(report.symmetries.maps.front().rms))
    throw Input_error("nothing is known of the symmetries of " + report.source +
                      ": it has a surface beside none of its points; give more points");
  if (report.symmetries.order() == 1U) report.advice = what_to_try(options);

  progress.begin("writing");
  auto file = outputs.files.begin();
  file++->stream() << to_JSON(report);
  if (is_shown) {
    const auto [mesh, attributes] = surface_with_symmetries(surface, report.symmetries);
    if (!options.display.arrows.empty() && !vector_columns(attributes, options.display.arrows))
      throw Input_error("--arrows: there is no vector '" + options.display.arrows +
                        "'; a continuous symmetry has generator1, and more of them if there are more dimensions");
    write_displays(file, mesh, attributes, options.display,
                   {page_title(options.output, "Symmetries"), description_of(report), notes_of(report)});
  }
  progress.end();
  commit_all(outputs.files);
  if (use_standard_output(outputs.files)) return;
  out << summary(report);
  report_written(out, outputs.files);
}

} // namespace equiaffine
