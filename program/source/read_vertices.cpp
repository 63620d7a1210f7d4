// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/read_vertices.h"

#include "source/Polygon_soup.h"
#include "system/file_format.h"
#include <equiaffine/fit/internal/Extent_of_fit.h>
#include <equiaffine/io/internal/xyz_colors_note.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

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
  if (Extent_of_fit::has(diagonal)) return;
  std::ostringstream reason;
  reason << "its points lie in a box with the diagonal " << diagonal << ", and fits work with " << Extent_of_fit::least
         << " to " << Extent_of_fit::greatest;
  fail(path, reason.str(), "choose another unit");
}

} // namespace equiaffine
