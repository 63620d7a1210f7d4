// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_output.h"

#include "write_VTP.h"
#include <equiaffine/Input_error.h>
#include <equiaffine/io/write_HTML.h>
#include <equiaffine/io/write_mesh.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

namespace equiaffine {

namespace {

#ifdef EQUIAFFINE_WITH_VTK
constexpr const char* known_extensions = ".ply .off .obj .stl .vtp .csv";
#else
constexpr const char* known_extensions = ".ply .off .obj .stl .csv";
#endif

bool is_VTP(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension == ".vtp";
}

} // namespace

void check_surface_output(const std::string& path) {
  if (path == "-" || mesh_format(path)) return;
#ifdef EQUIAFFINE_WITH_VTK
  if (is_VTP(path)) return;
#else
  if (is_VTP(path))
    throw Input_error("cannot write '" + path + "': this equiaffine was built without VTK; use one of " +
                      known_extensions);
#endif
  throw Input_error("cannot write '" + path + "': its extension is not known; use one of " + known_extensions);
}

void write_surface(Output_file& file, const Indexed_triangle_mesh_3<Kernel>& mesh,
                   const Vertex_attributes& attributes) {
#ifdef EQUIAFFINE_WITH_VTK
  if (is_VTP(file.path())) return write_VTP(file.stream(), mesh, attributes);
#endif
  write_mesh(file.stream(), mesh_format(file.path()).value_or(Mesh_format::OFF), mesh, attributes);
}

void write_page(Output_file& file, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                const Page_options& options, const Description& description) {
  Html_options page;
  page.color = attributes.columns.empty() && !attributes.status ? "plain" : options.color;
  page.up = options.up;
  page.description = description;
  write_HTML(file.stream(), mesh, attributes, page);
}

} // namespace equiaffine
