// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/read_mesh.h"

#include "system/files.h"
#include "system/memory_limit.h"
#include "system/process.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/exceptions.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

/// The words of a shared soup: the numbers of points and polygons, three coordinates per point, and per polygon the
/// number of its points and their positions.
using Word = std::uint64_t;

static_assert(sizeof(Word) == sizeof(double));

/// Copies a soup to shared memory.
void share(const Polygon_soup& soup, Shared_memory& memory) {
  std::vector<Word> words = {soup.points.size(), soup.polygons.size()};
  for (const Kernel::Point_3& p : soup.points)
    for (int axis = 0; axis < 3; ++axis) words.push_back(std::bit_cast<Word>(p[axis]));
  for (const auto& polygon : soup.polygons) {
    words.push_back(polygon.size());
    words.insert(words.end(), polygon.begin(), polygon.end());
  }
  std::memcpy(memory.allocate(words.size() * sizeof(Word)), words.data(), words.size() * sizeof(Word));
}

Polygon_soup soup_in(Shared_memory& memory) {
  const std::byte* place = memory.data();
  const auto next = [&place] {
    Word word;
    std::memcpy(&word, place, sizeof word);
    place += sizeof word;
    return word;
  };
  const auto coordinate = [&next] { return std::bit_cast<double>(next()); };
  Polygon_soup soup;
  const Word number_of_points = next(), number_of_polygons = next();
  soup.points.reserve(number_of_points);
  for (Word i = 0; i < number_of_points; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    soup.points.emplace_back(x, y, z);
  }
  soup.polygons.resize(number_of_polygons);
  for (auto& polygon : soup.polygons) {
    polygon.resize(next());
    for (std::size_t& position : polygon) position = next();
  }
  return soup;
}

/// Whether a word of a face in an OBJ file begins with an integer that ends at a slash or with the word. CGAL's reader
/// takes the integer part of other numbers.
bool is_position(const std::string& word) {
  std::size_t digits = word.starts_with('-') ? 1 : 0;
  const std::size_t begin = digits;
  while (digits < word.size() && std::isdigit(static_cast<unsigned char>(word[digits]))) ++digits;
  return digits > begin && (digits == word.size() || word[digits] == '/');
}

void check_faces_of_OBJ(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    for (std::string next; line.ends_with('\\') && std::getline(file, next); ++number)
      line.replace(line.size() - 1, 1, ' ' + next); // the line goes on
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word != "f") continue;
    while (words >> word && word[0] != '#')
      if (!is_position(word))
        fail_to_read_mesh(path, "a face in line " + std::to_string(number) + " has a vertex that is no integer",
                          "correct it");
  }
}

} // namespace

void fail_to_read_mesh(const std::string& path, const std::string& reason, const std::string& advice) {
  throw Input_error("cannot read the mesh " + (path == "-" ? "on standard input" : "'" + path + "'") + ": " + reason +
                    "; " + advice);
}

Polygon_soup read_foreign_soup(const std::string& path) {
  if (file_format(path) == File_format::OBJ) check_faces_of_OBJ(path);
  Polygon_soup soup;
  if (!CGAL::IO::read_polygon_soup(path, soup.points, soup.polygons))
    fail_to_read_mesh(path, "its content is not understood", "get the complete file again");
  return soup;
}

Polygon_soup make_in_child(const std::string& path, const std::function<Polygon_soup()>& make) {
  // A vertex or a face takes at least 6 bytes in a file, and up to 50 in each of three copies. Reading quadrangles and
  // cutting them takes a quarter of this time. A file that is larger than the memory is not read.
  constexpr double seconds = 10, bytes_per_second = 2e6, memory_for_small_files = 1 << 28, memory_per_byte = 32;
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  const double size = error ? 0 : std::min(double(bytes), physical_memory());
  Shared_memory memory;
  try {
    run_in_child([&] { share(make(), memory); },
                 {seconds + size / bytes_per_second, memory_for_small_files + memory_per_byte * size});
  } catch (const Child_failure& failure) {
    fail_to_read_mesh(path, std::string("the reader of this format ") + failure.what(), failure.advice());
  } catch (const std::bad_alloc&) {
    fail_to_read_mesh(path, "it does not fit into memory", "simplify it");
  }
  return soup_in(memory);
}

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

Polygon_soup to_soup(const Indexed_triangle_mesh_3<Kernel>& mesh) {
  Polygon_soup soup{mesh.points, {}};
  for (const auto& triangle : mesh.triangles) soup.polygons.emplace_back(triangle.begin(), triangle.end());
  return soup;
}

/// The triangles of an OBJ or STL file, by CGAL, which may crash where it reads and where it cuts other faces.
Polygon_soup read_foreign_triangles(const std::string& path) {
  Polygon_soup soup = read_foreign_soup(path);
  if (std::all_of(soup.polygons.begin(), soup.polygons.end(), [](const auto& face) { return face.size() == 3; }))
    return soup;
  const CGAL::Surface_mesh<Kernel::Point_3> mesh = to_triangle_mesh(std::move(soup), path);
  Polygon_soup triangles;
  pmp::polygon_mesh_to_polygon_soup(mesh, triangles.points, triangles.polygons);
  return triangles;
}

Polygon_soup read_soup(const std::string& path) {
  if (path == "-") return to_soup(read_OFF<Kernel>(std::cin, "standard input"));
  std::ifstream file = open_input(path);
  switch (file_format(path)) {
  case File_format::OFF: return to_soup(read_OFF<Kernel>(file, path));
  case File_format::PLY: return to_soup(read_PLY<Kernel>(file, path).mesh);
  case File_format::OBJ:
  case File_format::STL: return make_in_child(path, [&] { return read_foreign_triangles(path); });
  default: fail_to_read_mesh(path, "its extension is not known", "use one of .off .ply .obj .stl");
  }
}

/// The faces with a common orientation, cut where they form no surface; nothing if that is not enough.
CGAL::Surface_mesh<Kernel::Point_3> oriented_surface(Polygon_soup soup) {
  const auto repeats_a_point = [](std::vector<std::size_t> face) {
    std::sort(face.begin(), face.end());
    return std::adjacent_find(face.begin(), face.end()) != face.end();
  };
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  if (std::any_of(soup.polygons.begin(), soup.polygons.end(), repeats_a_point)) return mesh;
  pmp::remove_isolated_points_in_polygon_soup(soup.points, soup.polygons);
  pmp::orient_polygon_soup(soup.points, soup.polygons);
  if (pmp::is_polygon_soup_a_polygon_mesh(soup.polygons))
    pmp::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  return mesh;
}

/// Whether the faces could be cut into triangles. CGAL throws at some of those that touch themselves, and leaves a
/// damaged mesh where a diagonal of one is an edge of others.
bool cut_faces(CGAL::Surface_mesh<Kernel::Point_3>& mesh) {
  try {
    return pmp::triangulate_faces(mesh) && mesh.is_valid(false);
  } catch (const CGAL::Failure_exception&) {
    return false;
  }
}

} // namespace

CGAL::Surface_mesh<Kernel::Point_3> to_triangle_mesh(Polygon_soup soup, const std::string& path) {
  if (soup.polygons.empty()) fail_to_read_mesh(path, "it has no faces", "give a mesh of triangles");
  for (std::size_t f = 0; f < soup.polygons.size(); ++f)
    for (const std::size_t v : soup.polygons[f])
      if (v >= soup.points.size())
        fail_to_read_mesh(path,
                          "face " + std::to_string(f) + " has a vertex that the file does not have, which has " +
                              std::to_string(soup.points.size()),
                          "get the complete file again");
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const Kernel::Point_3& p = soup.points[v];
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
      fail_to_read_mesh(path, "vertex " + std::to_string(v) + " has a coordinate that is not a finite number",
                        "correct or remove it");
  }
  CGAL::Surface_mesh<Kernel::Point_3> mesh = oriented_surface(soup);
  if (mesh.is_empty() || !CGAL::is_closed(mesh)) { // points of a closed surface may coincide
    pmp::repair_polygon_soup(soup.points, soup.polygons);
    mesh = oriented_surface(std::move(soup));
  }
  if (mesh.is_empty())
    fail_to_read_mesh(path, "its faces do not form a surface", "repair it so that two faces meet at every edge");
  if (!cut_faces(mesh)) fail_to_read_mesh(path, "not every face can be cut into triangles", "triangulate it");
  return mesh;
}

std::vector<std::array<std::uint32_t, 3>> oriented_triangles(const Indexed_triangle_mesh_3<Kernel>& mesh) {
  Polygon_soup soup = to_soup(mesh);
  const auto repeats = [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
  if (std::any_of(mesh.triangles.begin(), mesh.triangles.end(), repeats) ||
      !pmp::orient_polygon_soup(soup.points, soup.polygons))
    return mesh.triangles;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& face : soup.polygons)
    triangles.push_back({std::uint32_t(face[0]), std::uint32_t(face[1]), std::uint32_t(face[2])});
  return triangles;
}

CGAL::Surface_mesh<Kernel::Point_3> read_triangle_mesh(const std::string& path) {
  return to_triangle_mesh(read_soup(path), path);
}

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason, const std::string& advice) {
  internal::fail_to_read(path == "-" ? "standard input" : path, reason, advice);
}

/// The points and faces of an OBJ or STL file in their order.
Point_table_3<Kernel> read_foreign_vertices(const std::string& path) {
  open_input(path);
  Polygon_soup soup = make_in_child(path, [&] { return read_foreign_soup(path); });
  Point_table_3<Kernel> table;
  for (std::size_t f = 0; f < soup.polygons.size(); ++f) {
    const auto& face = soup.polygons[f];
    if (std::any_of(face.begin(), face.end(), [&](std::size_t v) { return v >= soup.points.size(); }))
      fail(path, "face " + std::to_string(f) + " has a vertex that the file does not have",
           "get the complete file again");
    add_triangles_of_polygon(soup.points, {face.begin(), face.end()}, table.mesh.triangles);
  }
  table.mesh.points = std::move(soup.points);
  return table;
}

Point_table_3<Kernel> read_any_vertices(const std::string& path) {
  if (path == "-") return read_points<Kernel>(path);
  switch (file_format(path)) {
  case File_format::OBJ:
  case File_format::STL: return read_foreign_vertices(path);
  case File_format::PLY:
  case File_format::OFF:
  case File_format::CSV:
  case File_format::XYZ: return read_points<Kernel>(path);
  default: fail(path, "its extension is not known", "use one of .ply .off .obj .stl for a mesh, .csv .xyz for points");
  }
}

} // namespace

Point_table_3<Kernel> read_vertices(const std::string& path) {
  Point_table_3<Kernel> table = read_any_vertices(path);
  check_vertices(table.mesh.points, path);
  return table;
}

Point_table_3<Kernel> read_vertices(const Source_options& source) {
  if (!source.data) return read_vertices(source.text);
  Point_table_3<Kernel> table{source.data()};
  check_vertices(table.mesh.points, source.text);
  return table;
}

bool have_colors(const Annotated_mesh_3<Kernel>& points) {
  const auto& comments = points.attributes.comments;
  return std::find(comments.begin(), comments.end(), xyz_colors_note) != comments.end();
}

void check_vertices(const std::vector<Kernel::Point_3>& points, const std::string& path) {
  if (points.empty()) fail(path, "it has no points", "give a mesh, or points of a surface");
  CGAL::Bbox_3 box;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!std::isfinite(points[v].x()) || !std::isfinite(points[v].y()) || !std::isfinite(points[v].z()))
      fail(path, "point " + std::to_string(v) + ", counted from 0, has a coordinate that is not a finite number",
           "correct or remove it");
    box += points[v].bbox();
  }
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
  if (internal::Extent_of_fit::has(diagonal)) return;
  std::ostringstream reason;
  reason << "its points lie in a box with the diagonal " << diagonal << ", and fits work with "
         << internal::Extent_of_fit::least << " to " << internal::Extent_of_fit::greatest;
  fail(path, reason.str(), "choose another unit");
}

} // namespace equiaffine
