// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/read_mesh.h"

#include "system/files.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

void fail_to_read_mesh(const std::string& path, const std::string& reason, const std::string& advice) {
  throw Input_error("cannot read the mesh " + (path == "-" ? "on standard input" : "'" + path + "'") + ": " + reason +
                    "; " + advice);
}

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

struct Triangle_soup {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> triangles;
};

Triangle_soup to_soup(const Indexed_triangle_mesh_3<Kernel>& mesh) {
  Triangle_soup soup{mesh.points, {}};
  for (const auto& [a, b, c] : mesh.triangles)
    soup.triangles.push_back({std::size_t(a), std::size_t(b), std::size_t(c)});
  return soup;
}

bool repeats_a_point(const std::vector<std::size_t>& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// The consistently oriented triangles, cut open where they are not a manifold; empty if they still form no surface.
CGAL::Surface_mesh<Kernel::Point_3> oriented_surface(Triangle_soup soup) {
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  if (std::any_of(soup.triangles.begin(), soup.triangles.end(), repeats_a_point)) return mesh;
  pmp::remove_isolated_points_in_polygon_soup(soup.points, soup.triangles);
  pmp::orient_polygon_soup(soup.points, soup.triangles);
  if (pmp::is_polygon_soup_a_polygon_mesh(soup.triangles))
    pmp::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
  return mesh;
}

} // namespace

CGAL::Surface_mesh<Kernel::Point_3> to_surface(const Indexed_triangle_mesh_3<Kernel>& triangles,
                                               const std::string& path) {
  if (triangles.triangles.empty()) fail_to_read_mesh(path, "it has no faces", "give a mesh of triangles");
  Triangle_soup soup = to_soup(triangles);
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const Kernel::Point_3& p = soup.points[v];
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
      fail_to_read_mesh(path, "vertex " + std::to_string(v) + " has a coordinate that is not a finite number",
                        "correct or remove it");
  }
  CGAL::Surface_mesh<Kernel::Point_3> mesh = oriented_surface(soup);
  if (mesh.is_empty() || !CGAL::is_closed(mesh)) { // equal points of a closed surface stay separate
    pmp::repair_polygon_soup(soup.points, soup.triangles);
    mesh = oriented_surface(std::move(soup));
  }
  if (mesh.is_empty())
    fail_to_read_mesh(path, "its faces do not form a surface",
                      "repair the mesh so that at most two faces meet at every edge");
  return mesh;
}

std::vector<std::array<std::uint32_t, 3>> oriented_triangles(const Indexed_triangle_mesh_3<Kernel>& mesh) {
  Triangle_soup soup = to_soup(mesh);
  if (std::any_of(soup.triangles.begin(), soup.triangles.end(), repeats_a_point) ||
      !pmp::orient_polygon_soup(soup.points, soup.triangles))
    return mesh.triangles;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& face : soup.triangles)
    triangles.push_back({std::uint32_t(face[0]), std::uint32_t(face[1]), std::uint32_t(face[2])});
  return triangles;
}

CGAL::Surface_mesh<Kernel::Point_3> read_triangle_mesh(const std::string& path) {
  if (path == "-") return to_surface(read_OFF<Kernel>(std::cin, "standard input"), path);
  switch (file_format(path)) {
  case File_format::OFF:
  case File_format::PLY:
  case File_format::OBJ:
  case File_format::STL: return to_surface(read_points<Kernel>(path).mesh, path);
  default:
    open_input(path); // throws for a folder or a missing file
    fail_to_read_mesh(path, "unknown extension", "use one of .off .ply .obj .stl");
  }
}

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason, const std::string& advice) {
  internal::fail_to_read(path == "-" ? "standard input" : path, reason, advice);
}

Point_table_3<Kernel> read_any_vertices(const std::string& path) {
  if (path == "-") return read_points<Kernel>(path);
  switch (file_format(path)) {
  case File_format::OBJ:
  case File_format::STL:
  case File_format::PLY:
  case File_format::OFF:
  case File_format::CSV:
  case File_format::XYZ: return read_points<Kernel>(path);
  default: fail(path, "unknown extension", "use one of .ply .off .obj .stl for a mesh, .csv .xyz for points");
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
  reason << "the diagonal of its bounding box is " << diagonal << ", and fits need " << internal::Extent_of_fit::least
         << " to " << internal::Extent_of_fit::greatest;
  fail(path, reason.str(), "choose another unit");
}

} // namespace equiaffine
