// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/Outputs.h"

#include "output/Part_writer.h"
#include "system/files.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/write_curves.h>
#include <equiaffine/io/write_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace equiaffine {

Outputs::Outputs(const std::string& result, const Display_request& display) {
  add(Output_kind::RESULT, result);
  add_displays(display);
}

void Outputs::add(Output_kind kind, const std::optional<std::string>& path) {
  if (!path) return;
  files_.emplace_back(*path);
  kinds_.push_back(kind);
}

void Outputs::add_displays(const Display_request& options) {
  add(Output_kind::PAGE, options.html);
  add(Output_kind::PICTURE, options.png);
}

void Outputs::remove(Output_kind kind) {
  const auto found = std::find(kinds_.begin(), kinds_.end(), kind);
  if (found == kinds_.end()) return;
  files_.erase(files_.begin() + (found - kinds_.begin()));
  kinds_.erase(found);
}

Output_file* Outputs::find(Output_kind kind) {
  const auto found = std::find(kinds_.begin(), kinds_.end(), kind);
  return found == kinds_.end() ? nullptr : &files_[std::size_t(found - kinds_.begin())];
}

void Outputs::close_results() {
  for (std::size_t i = 0; i < files_.size(); ++i)
    if (kinds_[i] != Output_kind::STATISTICS) files_[i].close();
}

void Outputs::commit() { commit_all(files_); }

namespace {

constexpr const char *surface_extensions = ".ply .off .obj .stl .vtp .csv", *vertices_extensions = ".ply .csv .vtp";
#ifdef EQUIAFFINE_WITH_VTK
constexpr bool has_vtk = true;
constexpr const char* curves_extensions = ".obj .vtp";
#else
constexpr bool has_vtk = false;
constexpr const char* curves_extensions = ".obj";
#endif

bool is_VTP(const std::string& path) { return file_format(path) == File_format::VTP; }

void check_output(const std::string& path, bool is_known, const std::string& known_extensions) {
  if (path == "-" || is_known) return;
  throw Input_error("cannot write '" + path + "': unknown extension; use one of " + known_extensions);
}

template <class Number>
std::size_t number_of_distinct(const std::vector<Kernel::Point_3>& points) {
  std::vector<std::array<Number, 3>> rounded;
  for (const auto& p : points) rounded.push_back({Number(p.x()), Number(p.y()), Number(p.z())});
  std::sort(rounded.begin(), rounded.end());
  return std::size_t(std::unique(rounded.begin(), rounded.end()) - rounded.begin());
}

} // namespace

void check_format(const std::string& path, File_format right, const std::string& kind, const std::string& advised) {
  const File_format format = file_format(path);
  if (path == "-" || format == right || format == File_format::UNNAMED) return;
  throw Input_error("cannot write '" + path + "': the extension does not belong to " + kind + "; use " + advised);
}

void check_surface_output(const std::string& path) {
  check_output(path, mesh_format(path).has_value() || is_VTP(path), surface_extensions);
}

void check_curves_output(const std::string& path) {
  if (is_VTP(path) && !has_vtk)
    throw Input_error("cannot write '" + path + "': this equiaffine was built without VTK; use .obj");
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

void warn_of_lost_points(const std::string& path, const std::vector<Kernel::Point_3>& points, Progress& progress) {
  if (file_format(path) != File_format::STL) return;
  const std::size_t given = number_of_distinct<double>(points), left = number_of_distinct<float>(points);
  if (100 * (given - left) < given || given == left) return;
  progress.warn("STL has single precision, in which " + std::to_string(given - left) + " of " + std::to_string(given) +
                " vertices coincide with others; write .ply, .off or .obj, or move the surface to the origin");
}

} // namespace equiaffine
