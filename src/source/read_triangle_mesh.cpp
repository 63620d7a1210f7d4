// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/read_triangle_mesh.h"

#include <equiaffine/Input_error.h>
#include <equiaffine/io/input_file.h>
#include <equiaffine/io/read_OFF.h>
#include <equiaffine/io/read_PLY.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <vector>

namespace equiaffine {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

struct Polygon_soup {
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
};

[[noreturn]] void fail(const std::string& path, const std::string& reason, const std::string& advice) {
  throw Input_error("cannot read the mesh " + (path == "-" ? "on standard input" : "'" + path + "'") + ": " + reason +
                    "; " + advice);
}

Polygon_soup to_soup(const Indexed_triangle_mesh_3<Kernel>& mesh) {
  Polygon_soup soup{mesh.points, {}};
  for (const auto& triangle : mesh.triangles) soup.polygons.emplace_back(triangle.begin(), triangle.end());
  return soup;
}

Polygon_soup read_soup(const std::string& path) {
  if (path == "-") return to_soup(read_OFF<Kernel>(std::cin, "standard input"));
  std::ifstream file = open_input(path);
  if (has_extension(path, ".off")) return to_soup(read_OFF<Kernel>(file, path));
  if (has_extension(path, ".ply")) return to_soup(read_PLY<Kernel>(file, path).mesh);
  if (!has_extension(path, ".obj") && !has_extension(path, ".stl"))
    fail(path, "its extension is not known", "use one of .off .ply .obj .stl");
  Polygon_soup soup;
  if (!CGAL::IO::read_polygon_soup(path, soup.points, soup.polygons))
    fail(path, "its content is not understood", "get the complete file again");
  return soup;
}

} // namespace

CGAL::Surface_mesh<Kernel::Point_3> read_triangle_mesh(const std::string& path) {
  Polygon_soup soup = read_soup(path);
  if (soup.polygons.empty()) fail(path, "it has no faces", "give a mesh of triangles");
  for (std::size_t v = 0; v < soup.points.size(); ++v) {
    const Kernel::Point_3& p = soup.points[v];
    if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z()))
      fail(path, "vertex " + std::to_string(v) + " has a coordinate that is not a finite number",
           "correct or remove it");
  }
  pmp::repair_polygon_soup(soup.points, soup.polygons);
  pmp::orient_polygon_soup(soup.points, soup.polygons);
  if (!pmp::is_polygon_soup_a_polygon_mesh(soup.polygons))
    fail(path, "its faces do not form a surface", "repair it so that two faces meet at every edge");
  CGAL::Surface_mesh<Kernel::Point_3> mesh;
  pmp::polygon_soup_to_polygon_mesh(soup.points, soup.polygons, mesh);
  if (!pmp::triangulate_faces(mesh)) fail(path, "not every face can be cut into triangles", "triangulate it");
  return mesh;
}

} // namespace equiaffine
