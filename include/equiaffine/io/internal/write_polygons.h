// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_WRITE_POLYGONS_H
#define EQUIAFFINE_IO_INTERNAL_WRITE_POLYGONS_H

#include <equiaffine/io/internal/Ply_writer.h>
#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/io/internal/mesh_text.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <span>
#include <vector>

// Formats that hold polygons. A polygon is a range of positions of points.
namespace equiaffine::internal {

template <class Point, class Polygon>
void write_PLY_of(std::ostream& stream, const std::vector<Point>& points, const std::vector<Polygon>& polygons,
                  const Vertex_attributes& attributes) {
  Ply_writer writer(stream, points.size(), polygons.size(), attributes);
  writer.write_vertices(std::span<const Point>(points), attributes);
  writer.write_faces(polygons);
  writer.flush();
}

template <class Point, class Polygon>
void write_OFF_of(std::ostream& stream, const std::vector<Point>& points, const std::vector<Polygon>& polygons) {
  Buffered_output out(stream);
  out << "OFF\n" << points.size() << ' ' << polygons.size() << " 0\n";
  for (const auto& p : points) write_line(out, "", coordinates(p));
  for (const auto& polygon : polygons) {
    out << std::size_t(polygon.size());
    for (const std::uint32_t v : polygon) out << ' ' << std::size_t(v);
    out << '\n';
  }
  out.flush();
}

template <class Point, class Polygon>
void write_OBJ_of(std::ostream& stream, const std::vector<Point>& points, const std::vector<Polygon>& polygons,
                  const Vertex_attributes& attributes) {
  const std::array<const Vertex_attributes::Column*, 3> normal = {
      find_column(attributes, "nx"), find_column(attributes, "ny"), find_column(attributes, "nz")};
  const bool has_normals = normal[0] && normal[1] && normal[2];
  Buffered_output out(stream);
  for (const auto& p : points) write_line(out, "v ", coordinates(p));
  if (has_normals)
    for (std::size_t v = 0; v < points.size(); ++v)
      write_line(out, "vn ", {normal[0]->values[v], normal[1]->values[v], normal[2]->values[v]});
  for (const auto& polygon : polygons) {
    out << 'f';
    for (const std::uint32_t v : polygon) {
      out << ' ' << std::size_t(v) + 1;
      if (has_normals) out << "//" << std::size_t(v) + 1;
    }
    out << '\n';
  }
  out.flush();
}

} // namespace equiaffine::internal

#endif
