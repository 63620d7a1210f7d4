// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/surface_output.h"

#include "output/Part_writer.h"
#include "output/decimate.h"
#include "output/read_mappings.h"
#include "output/write_VTP.h"
#include "picture/natural_up.h"
#include "picture/write_PNG.h"
#include "system/file_format.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/display/internal/trust.h>
#include <equiaffine/display/write_HTML.h>
#include <equiaffine/io/write_curves.h>
#include <equiaffine/io/write_mesh.h>

#include <array>
#include <filesystem>
#include <map>
#include <sstream>

namespace equiaffine {

namespace {

constexpr const char *surface_extensions = ".ply .off .obj .stl .vtp .csv", *vertices_extensions = ".ply .csv .vtp";
#ifdef EQUIAFFINE_WITH_VTK
constexpr bool has_vtk = true;
constexpr const char* curves_extensions = ".obj .vtp";
#else
constexpr bool has_vtk = false;
constexpr const char* curves_extensions = ".obj";
#endif

/// The most triangles that a page has: beyond, browsers are slow, or fail.
constexpr std::size_t most_triangles_of_page = 2'000'000;

bool is_VTP(const std::string& path) { return file_format(path) == File_format::VTP; }

void check_output(const std::string& path, bool is_known, const std::string& known_extensions) {
  if (path == "-" || is_known) return;
  throw Input_error("cannot write '" + path + "': its extension is not known; use one of " + known_extensions);
}

/// Throws if the file has the extension of another format: what looks like a mesh is not to become a page.
void check_format(const std::string& path, File_format right, const std::string& kind, const std::string& advised) {
  const File_format format = file_format(path);
  if (path == "-" || format == right || format == File_format::UNNAMED) return;
  throw Input_error("cannot write '" + path + "': it is to be " + kind + "; give it the extension " + advised);
}

/// The mappings in that file. Throws `Input_error` if there is none for the column that is shown first.
std::map<std::string, Color_mapping> shared_mappings(const std::string& path, const Vertex_attributes& attributes,
                                                     const std::string& color) {
  auto mappings = read_mappings(path);
  const std::string shown = color.empty() ? first_shown(attributes) : color;
  if (find_column(attributes, shown) && !mappings.contains(shown))
    throw Input_error("--range-of: '" + path + "' has no attribute '" + shown +
                      "'; name one that it has, --color NAME");
  return mappings;
}

/// Writes the page, of a coarser mesh if there are too many triangles, which it says then.
void write_page(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                Html_options& page) {
  if (mesh.triangles.size() <= most_triangles_of_page) return write_HTML(stream, mesh, attributes, page);
  const Displayed_mesh shown = decimate(mesh, attributes, most_triangles_of_page);
  page.description.emplace_back("Shown here", std::to_string(shown.mesh.triangles.size()) +
                                                  " triangles between some of the vertices; colors and statistics "
                                                  "are theirs");
  write_HTML(stream, shown.mesh, shown.attributes, page);
}

} // namespace

void check_surface_output(const std::string& path) {
  check_output(path, mesh_format(path).has_value() || is_VTP(path), surface_extensions);
}

void check_curves_output(const std::string& path) {
  if (is_VTP(path) && !has_vtk)
    throw Input_error("cannot write '" + path + "': this equiaffine was built without VTK; use one of .obj");
  check_output(path, file_format(path) == File_format::OBJ || is_VTP(path), curves_extensions);
}

void write_surface(Output_file& file, const Indexed_triangle_mesh_3<Kernel>& mesh,
                   const Vertex_attributes& attributes) {
  if (!is_VTP(file.path()))
    return write_mesh(file.stream(), mesh_format(file.path()).value_or(Mesh_format::OFF), mesh, attributes);
  const auto writer = part_writer(file.path(), file.stream(), mesh.points.size(), mesh.triangles.size(), attributes);
  writer->write_vertices(mesh.points, attributes);
  writer->write_faces(mesh.triangles);
}

void check_vertices_output(const std::string& path) {
  const auto format = mesh_format(path);
  if (format && format != Mesh_format::PLY && format != Mesh_format::CSV)
    throw Input_error("cannot write '" + path + "': its format has no attributes; use one of " + vertices_extensions);
  check_output(path, format.has_value() || is_VTP(path), vertices_extensions);
}

void write_vertices(Output_file& file, const Point_table_3<Kernel>& table, const Vertex_attributes& attributes) {
  if (file.path() == "-" || mesh_format(file.path()) == Mesh_format::CSV)
    return write_CSV(file.stream(), table, attributes);
  write_surface(file, table.mesh, merge_attributes(table.attributes, attributes));
}

void write_curves(Output_file& file, const Parabolic_curves_3<Kernel>& curves) {
#ifdef EQUIAFFINE_WITH_VTK
  if (is_VTP(file.path())) return write_VTP(file.stream(), curves);
#endif
  write_OBJ(file.stream(), curves);
}

void check_statistics_output(const std::string& path) {
  check_format(path, File_format::JSON, "a file of statistics", ".json");
}

void check_maps_output(const std::string& path) { check_format(path, File_format::JSON, "a file of maps", ".json"); }

std::string number_text(double number, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << number;
  return text.str();
}

std::string page_title(const std::string& path, const std::string& otherwise) {
  return path == "-" ? otherwise : std::filesystem::path(path).stem().string();
}

void check_display_outputs(const Display_options& options) {
  if (options.html) check_format(*options.html, File_format::HTML, "a page", ".html");
  if (options.range_of) read_mappings(*options.range_of); // an error is to come before the work
  if (!options.png) return;
  if (!has_vtk)
    throw Input_error("cannot write '" + *options.png + "': this equiaffine was built without VTK; use --html");
  if (options.png != "-" && file_format(*options.png) != File_format::PNG)
    throw Input_error("cannot write '" + *options.png + "': a picture is a PNG file; give it the extension .png");
}

void write_displays(Outputs& outputs, const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                    const Display_options& options, const Surface_texts& texts,
                    [[maybe_unused]] const std::vector<Polyline_3<Kernel>>& curves) {
  const std::array<double, 3> up = options.up ? *options.up : natural_up(mesh.points);
  std::map<std::string, Color_mapping> mappings;
  if (options.range_of) mappings = shared_mappings(*options.range_of, attributes, options.color);
  if (Output_file* const file = outputs.find(Output_kind::PAGE)) {
    Html_options page;
    page.title = texts.title;
    page.range = options.range;
    page.color = attributes.columns.empty() && !attributes.status ? "plain" : options.color;
    page.up = up;
    page.scale = options.scale;
    page.mappings = mappings;
    page.label_suffix = texts.label_suffix;
    page.description = texts.description;
    write_page(file->stream(), mesh, attributes, page);
  }
#ifdef EQUIAFFINE_WITH_VTK
  if (Output_file* const file = outputs.find(Output_kind::PICTURE)) {
    const Surface_view view = {options.color, up,       options.size,       options.range, options.arrows,
                               options.scale, mappings, texts.label_suffix, texts.notes};
    write_PNG(file->stream(), draw_surface(mesh, attributes, view, curves));
  }
#endif
}

} // namespace equiaffine
