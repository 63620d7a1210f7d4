// SPDX-License-Identifier: GPL-3.0-or-later
// Reads polygon files in the format of their extension, and writes them completely or not at all.
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/polygon_mesh_files.h>
#include <equiaffine/io/read_points.h>
#include <equiaffine/io/write_CSV.h>
#include <equiaffine/io/write_mesh.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <system_error>
#include <vector>

namespace equiaffine::internal {

namespace {

/// A temporary file that replaces another one when it is complete, and is removed otherwise. Preserves the
/// permissions of the replaced file, and links.
class Whole_file {
public:
  explicit Whole_file(const std::string& path) : path_(path), target_(std::filesystem::weakly_canonical(path, error_)) {
    if (error_) target_ = path;
    temporary_ = target_.parent_path() / (".equiaffine-" + std::to_string(std::random_device()()) + ".part");
    stream_.open(temporary_, std::ios::binary);
    if (!stream_) fail("its folder does not exist or is not writable; choose another folder");
  }
  Whole_file(const Whole_file&) = delete;
  Whole_file& operator=(const Whole_file&) = delete;
  ~Whole_file() { std::filesystem::remove(temporary_, error_); }

  std::ostream& stream() { return stream_; }

  void commit() {
    stream_.close();
    if (!stream_) fail("the disk is full or broken; choose another folder");
    const auto replaced = std::filesystem::status(target_, error_);
    if (std::filesystem::is_regular_file(replaced))
      std::filesystem::permissions(temporary_, replaced.permissions(), error_);
    std::filesystem::rename(temporary_, target_, error_);
    if (error_) fail(error_.message());
  }

private:
  [[noreturn]] void fail(const std::string& advice) const {
    throw Input_error("cannot write '" + path_ + "': " + advice);
  }

  std::string path_;
  std::error_code error_;
  std::filesystem::path target_, temporary_;
  std::ofstream stream_;
};

/// Calls `write(stream)` for a file that replaces the one at `path` when it is complete. \throw Input_error if it
/// cannot be written
template <class Write>
void write_whole_file(const std::string& path, const Write& write) {
  Whole_file file(path);
  write(file.stream());
  file.commit();
}

/// Throws if two columns have the same name, or one has that of a coordinate, because readers could not distinguish
/// them.
void check_column_names(const std::string& path, const Vertex_attributes& attributes) {
  std::set<std::string> names = {"x", "y", "z", "X", "Y", "Z"};
  if (attributes.status) names.insert("status");
  for (const auto& column : attributes.columns)
    if (!names.insert(column.name).second)
      throw Input_error("cannot write '" + path + "': '" + column.name +
                        "' would be the name of two property maps, or of a map and a coordinate; rename one of them");
}

} // namespace

Polygons_of_file polygons_of_file(const std::string& path) {
  Polygons_of_file result;
  const Mesh_receiver receiver = {[&](std::size_t points, std::size_t) { result.points.reserve(points); },
                                  [&](double x, double y, double z) { result.points.emplace_back(x, y, z); },
                                  [&](const std::vector<std::uint32_t>& face) { result.polygons.push_back(face); }};
  std::ifstream file = open_input(path);
  if (has_extension(path, ".ply")) result.attributes = read_PLY_elements(file, path, receiver);
  else if (has_extension(path, ".off")) read_OFF_elements(file, path, receiver);
  else if (has_extension(path, ".obj")) read_OBJ_elements(file, path, receiver);
  else if (has_extension(path, ".stl")) read_STL_elements(file, path, receiver);
  else fail_to_read(path, "its extension is not known", "use one of .ply .off .obj .stl");
  return result;
}

void write_polygon_file(const std::string& path, const Indexed_polygons& mesh, const Vertex_attributes& attributes) {
  const auto format = mesh_format(path);
  if (!format)
    throw Input_error("cannot write '" + path + "': its extension is not known; use one of .ply .csv .obj .off .stl");
  const auto is_large = [](const auto& polygon) { return polygon.size() > 255; };
  if (format == Mesh_format::PLY && std::any_of(mesh.polygons.begin(), mesh.polygons.end(), is_large))
    throw Input_error("cannot write '" + path + "': a face has more than 255 corners; use .off");
  check_column_names(path, attributes);
  write_whole_file(path, [&](std::ostream& stream) {
    switch (*format) {
    case Mesh_format::PLY: return write_PLY_of(stream, mesh.points, mesh.polygons, attributes);
    case Mesh_format::OFF: return write_OFF_of(stream, mesh.points, mesh.polygons);
    case Mesh_format::OBJ: return write_OBJ_of(stream, mesh.points, mesh.polygons, attributes);
    case Mesh_format::CSV: return write_CSV(stream, mesh.points, attributes);
    case Mesh_format::STL: {
      Indexed_triangle_mesh_3<CGAL::Simple_cartesian<double>> triangles;
      for (const auto& p : mesh.points) triangles.points.emplace_back(p[0], p[1], p[2]);
      for (const auto& polygon : mesh.polygons) add_triangles_of_polygon(mesh.points, polygon, triangles.triangles);
      return write_STL(stream, triangles);
    }
    }
  });
}

} // namespace equiaffine::internal
