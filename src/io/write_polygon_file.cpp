// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write_whole_file.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/internal/write_polygon_file.h>
#include <equiaffine/io/internal/write_polygons.h>
#include <equiaffine/io/write_CSV.h>
#include <equiaffine/io/write_mesh.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <ostream>
#include <set>
#include <string>

namespace equiaffine::internal {

namespace {

/// Throws if two columns have one name, or one has that of a coordinate, since a reader would take one for the other.
void check_column_names(const std::string& path, const Vertex_attributes& attributes) {
  std::set<std::string> names = {"x", "y", "z", "X", "Y", "Z"};
  if (attributes.status) names.insert("status");
  for (const auto& column : attributes.columns)
    if (!names.insert(column.name).second)
      throw Input_error(
          "cannot write '" + path + "': there '" + column.name +
          "' would be the name of two property maps, or of a map and a coordinate; give one another name");
}

} // namespace

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
