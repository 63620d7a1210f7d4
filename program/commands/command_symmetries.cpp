// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/commands.h"
#include "commands/find_symmetries.h"
#include "commands/maps_view.h"
#include "output/maps.h"
#include "output/maps_display.h"
#include "output/surface_output.h"
#include "picture/draw_surface.h"
#include "system/atomic_file.h"
#include <equiaffine/base/Input_error.h>

#include <string>

namespace equiaffine {

namespace {

Outputs outputs_of(const Symmetries_options& options) {
  check_maps_output(options.output);
  check_display_outputs(options.display);
  return Outputs(options.output, options.display);
}

} // namespace

void run_symmetries(const Symmetries_options& options, std::ostream& out, Progress& progress) {
  Outputs outputs = outputs_of(options);
  Found_symmetries found = find_symmetries(options, progress);
  const Symmetries_report report = report_of(options, found);
  progress.begin("writing");
  outputs[Output_kind::RESULT].stream() << to_JSON(report);
  if (options.display.shows_something()) {
    const auto [mesh, attributes] = found.shown();
    if (!options.display.arrows.empty() && !vector_columns(attributes, options.display.arrows))
      throw Input_error("--arrows: there is no vector '" + options.display.arrows +
                        "'; a continuous symmetry has generator1, and more of them if there are more dimensions");
    const Display_options display = display_of(report, options.display);
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
