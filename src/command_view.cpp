// SPDX-License-Identifier: GPL-3.0-or-later
#include "atomic_file.h"
#include "commands.h"
#include "surface_output.h"
#include <equiaffine/Input_error.h>
#include <equiaffine/internal/text_input.h>
#include <equiaffine/io/read_PLY.h>

#include <algorithm>
#include <fstream>
#include <iostream>

namespace equiaffine {

namespace {

Annotated_mesh_3<Kernel> read_mesh(const std::string& path) {
  if (path == "-") return read_PLY<Kernel>(std::cin, "standard input");
  std::ifstream file = internal::open_input(path);
  return read_PLY<Kernel>(file, path);
}

void check_color(const std::string& color, const Vertex_attributes& attributes) {
  const bool is_column = std::any_of(attributes.columns.begin(), attributes.columns.end(),
                                     [&](const auto& column) { return column.name == color; });
  if (color.empty() || color == "plain" || (color == "status" && attributes.status) || is_column) return;
  std::string names;
  for (const auto& column : attributes.columns) names += column.name + ' ';
  throw Input_error("--color: the mesh has no attribute '" + color + "'; use one of " + names + "or plain");
}

} // namespace

void run_view(const View_options& options, std::ostream& out) {
  Output_file output(options.output);
  const Annotated_mesh_3<Kernel> surface = read_mesh(options.mesh);
  if (surface.mesh.triangles.empty())
    throw Input_error("cannot show '" + options.mesh + "': it has no faces; give a mesh");
  check_color(options.page.color, surface.attributes);
  write_page(output, surface.mesh, surface.attributes, options.page,
             {{"File", options.mesh},
              {"Vertices", std::to_string(surface.mesh.points.size())},
              {"Triangles", std::to_string(surface.mesh.triangles.size())}});
  output.commit();
  if (options.output != "-") out << "wrote " << options.output << '\n';
}

} // namespace equiaffine
