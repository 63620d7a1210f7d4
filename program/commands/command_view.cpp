// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/commands.h"
#include "output/displays.h"
#include "picture/draw_surface.h"
#include "system/files.h"
#include "system/front_end.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>

#include <algorithm>
#include <fstream>
#include <iostream>

namespace equiaffine {

namespace {

Annotated_mesh_3<Kernel> read_mesh(const std::string& path) {
  if (path == "-") return read_PLY<Kernel>(std::cin, "standard input");
  std::ifstream file = open_input(path);
  return read_PLY<Kernel>(file, path);
}

void check_color(const std::string& color, const Vertex_attributes& attributes) {
  const bool is_column = std::any_of(attributes.columns.begin(), attributes.columns.end(),
                                     [&](const auto& column) { return column.name == color; });
  if (color.empty() || color == "plain" || (color == "status" && attributes.status) || is_column) return;
  std::string names;
  for (const auto& column : attributes.columns) names += column.name + ' ';
  throw Input_error(option_text("color") + ": the mesh has no attribute '" + color + "'; use one of " + names +
                    "plain");
}

void check_arrows(const std::string& arrows, const Vertex_attributes& attributes) {
  if (!arrows.empty() && !vector_columns(attributes, arrows))
    throw Input_error(option_text("arrows") + ": the mesh has no vector '" + arrows + "'; it needs columns " + arrows +
                      "_x, " + arrows + "_y and " + arrows + "_z");
}

} // namespace

Outputs show(const Annotated_mesh_3<Kernel>& surface, const std::string& name, const Request& options) {
  check_display_outputs(options.display);
  Outputs outputs;
  outputs.add_displays(options.display);
  if (options.display.html && surface.mesh.triangles.empty())
    throw Input_error("cannot show '" + name + "': it has no faces; " +
                      by_front_end("draw the points with --png, or show the surface through them with 'equiaffine "
                                   "mesh --fit " +
                                       options.input + " -o OUT.ply --html PAGE.html'",
                                   "draw the points into a .png, or show fit(V).mesh(), the surface through them"));
  check_color(options.display.color, surface.attributes);
  check_arrows(options.display.arrows, surface.attributes);
  const Description fit = description_of_fit(surface.attributes);
  Description description = {{"File", name},
                             {"Vertices", std::to_string(surface.mesh.points.size())},
                             {"Triangles", std::to_string(surface.mesh.triangles.size())}};
  description.insert(description.end(), fit.begin(), fit.end());
  write_displays(
      outputs, surface.mesh, surface.attributes, options.display,
      {page_title(options.input, "Surface") + label_suffix(fit), description, notes_of(fit), label_suffix(fit)});
  outputs.commit();
  return outputs;
}

void run_view(const Request& options, std::ostream& out) {
  check_display_outputs(options.display);
  const std::string name = options.input == "-" ? "standard input" : name_of_file(options.input);
  const Outputs outputs = show(read_mesh(options.input), name, options);
  if (!outputs.use_standard_output()) outputs.report(out);
}

} // namespace equiaffine
