// SPDX-License-Identifier: GPL-3.0-or-later
// Writes an indexed mesh and the attributes of its vertices as PLY, OFF, OBJ, STL, or CSV. Text has 17 significant
// digits, and `nan` for missing numbers. All functions write to a stream, which must be binary for PLY and STL.
// Errors are reported by its state.
#ifndef EQUIAFFINE_IO_WRITE_MESH_H
#define EQUIAFFINE_IO_WRITE_MESH_H

#include <equiaffine/io/internal/Ply_writer.h>
#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/write_CSV.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

struct Indexed_polygons;

} // namespace equiaffine

namespace equiaffine::internal {

// Formats that hold polygons. A polygon is a range of point indices.

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

// This function is compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Writes polygons in the format of the path's extension, with the attributes that the format supports.
void write_polygon_file(const std::string& path, const Indexed_polygons& mesh, const Vertex_attributes& attributes);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

} // namespace equiaffine::internal

namespace equiaffine {

/// The file formats for meshes.
enum class Mesh_format {
  PLY, ///< write_PLY()
  OFF, ///< write_OFF()
  OBJ, ///< write_OBJ()
  STL, ///< write_STL()
  CSV  ///< write_CSV(), without triangles
};

/// The format of a path's extension, in lower or upper case; nothing if it is unknown.
inline std::optional<Mesh_format> mesh_format(const std::string& path) {
  constexpr std::array<std::string_view, 5> extensions = {".ply", ".off", ".obj", ".stl", ".csv"};
  for (std::size_t i = 0; i < extensions.size(); ++i)
    if (has_extension(path, extensions[i])) return static_cast<Mesh_format>(i);
  return std::nullopt;
}

/// Writes PLY, binary little-endian: `double x y z`, a `double` property per column, `uchar status`, `vertex_indices`,
/// and the comments.
template <class Kernel>
void write_PLY(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh,
               const Vertex_attributes& attributes = {}) {
  internal::write_PLY_of(stream, mesh.points, mesh.triangles, attributes);
}

/// Writes OFF: points and triangles; attributes are not supported.
template <class Kernel>
void write_OFF(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh) {
  internal::write_OFF_of(stream, mesh.points, mesh.triangles);
}

/// Writes OBJ: points and triangles, and vertex normals if there are columns `nx ny nz`.
template <class Kernel>
void write_OBJ(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh,
               const Vertex_attributes& attributes = {}) {
  internal::write_OBJ_of(stream, mesh.points, mesh.triangles, attributes);
}

/// Writes STL, binary: triangles in single precision with their unit normals; attributes are not supported. Triangles
/// with two corners that coincide in single precision are omitted: a reader joins coinciding corners, so its mesh is
/// closed where this one is.
template <class Kernel>
void write_STL(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh) {
  constexpr std::size_t header_size = 80;
  using Corner = std::array<float, 3>;
  const auto written_corner = [&](std::uint32_t v) {
    const auto [x, y, z] = internal::coordinates(mesh.points[v]);
    return Corner{float(x), float(y), float(z)};
  };
  const auto is_written = [&](const std::array<std::uint32_t, 3>& triangle) {
    const Corner a = written_corner(triangle[0]), b = written_corner(triangle[1]), c = written_corner(triangle[2]);
    return a != b && b != c && c != a;
  };
  std::string header = "binary STL made by equiaffine";
  header.resize(header_size, ' ');
  internal::Buffered_output out(stream);
  out << header;
  out.write_binary(std::uint32_t(std::count_if(mesh.triangles.begin(), mesh.triangles.end(), is_written)));
  for (const auto& triangle : mesh.triangles) {
    if (!is_written(triangle)) continue;
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = internal::coordinates(mesh.points[triangle[i]]);
    for (const double x : internal::unit_normal(corners)) out.write_binary(float(x));
    for (const std::uint32_t v : triangle)
      for (const float x : written_corner(v)) out.write_binary(x);
    out.write_binary(std::uint16_t(0));
  }
  out.flush();
}

/// Writes the mesh in the given format, with the attributes that the format supports.
template <class Kernel>
void write_mesh(std::ostream& stream, Mesh_format format, const Indexed_triangle_mesh_3<Kernel>& mesh,
                const Vertex_attributes& attributes = {}) {
  switch (format) {
  case Mesh_format::PLY: return write_PLY(stream, mesh, attributes);
  case Mesh_format::OFF: return write_OFF(stream, mesh);
  case Mesh_format::OBJ: return write_OBJ(stream, mesh, attributes);
  case Mesh_format::STL: return write_STL(stream, mesh);
  case Mesh_format::CSV: return write_CSV(stream, mesh.points, attributes);
  }
}

} // namespace equiaffine

#endif
