// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/read_triangle_mesh.h"

#include "system/file_format.h"
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_OFF.h>
#include <equiaffine/io/read_PLY.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_mesh_to_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/exceptions.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <utility>
#include <vector>

namespace equiaffine {

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

} // namespace equiaffine
