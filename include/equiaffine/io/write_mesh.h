// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a mesh with its attributes as PLY, OFF, OBJ, STL or CSV, as the name of a file says.
#ifndef EQUIAFFINE_IO_WRITE_MESH_H
#define EQUIAFFINE_IO_WRITE_MESH_H

// Writes an indexed triangle mesh and the numbers at its vertices. Text has 17 significant digits and `nan` for numbers
// that do not exist. All functions write to a stream, which has to be binary for PLY and STL. Errors are in its state.

#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/io/internal/mesh_text.h>
#include <equiaffine/io/internal/shared/input_file.h>
#include <equiaffine/io/write_CSV.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <CGAL/assertions.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

namespace equiaffine {

/// The formats of files that a mesh is written to.
enum class Mesh_format {
  PLY, ///< write_PLY()
  OFF, ///< write_OFF()
  OBJ, ///< write_OBJ()
  STL, ///< write_STL()
  CSV  ///< write_CSV(), without triangles
};

/// The format that the extension of a path stands for, in lower or upper case, if there is one.
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
  CGAL_precondition(attributes.has_length(mesh.points.size()));
  internal::Buffered_output out(stream);
  internal::write_ply_header(out, mesh.points.size(), mesh.triangles.size(), attributes);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    for (const double x : internal::coordinates(mesh.points[v])) out.write_binary(x);
    for (const auto& column : attributes.columns) out.write_binary(column.values[v]);
    if (attributes.status) out.write_binary(static_cast<std::uint8_t>((*attributes.status)[v]));
  }
  for (const auto& triangle : mesh.triangles) {
    out.write_binary(std::uint8_t(3));
    for (const std::uint32_t v : triangle) out.write_binary(v);
  }
  out.flush();
}

/// Writes OFF: points and triangles; it holds no attributes.
template <class Kernel>
void write_OFF(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh) {
  internal::Buffered_output out(stream);
  out << "OFF\n" << mesh.points.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const auto& p : mesh.points) internal::write_line(out, "", internal::coordinates(p));
  for (const auto& [a, b, c] : mesh.triangles)
    out << "3 " << std::size_t(a) << ' ' << std::size_t(b) << ' ' << std::size_t(c) << '\n';
  out.flush();
}

/// Writes OBJ: points and triangles, and vertex normals if there are columns `nx ny nz`.
template <class Kernel>
void write_OBJ(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh,
               const Vertex_attributes& attributes = {}) {
  const std::array<const Vertex_attributes::Column*, 3> normal = {
      find_column(attributes, "nx"), find_column(attributes, "ny"), find_column(attributes, "nz")};
  const bool has_normals = normal[0] && normal[1] && normal[2];
  internal::Buffered_output out(stream);
  for (const auto& p : mesh.points) internal::write_line(out, "v ", internal::coordinates(p));
  if (has_normals)
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      internal::write_line(out, "vn ", {normal[0]->values[v], normal[1]->values[v], normal[2]->values[v]});
  for (const auto& triangle : mesh.triangles) {
    out << 'f';
    for (const std::uint32_t v : triangle) {
      out << ' ' << std::size_t(v) + 1;
      if (has_normals) out << "//" << std::size_t(v) + 1;
    }
    out << '\n';
  }
  out.flush();
}

/// Writes STL, binary: triangles in single precision with their own unit normals; it holds no attributes.
template <class Kernel>
void write_STL(std::ostream& stream, const Indexed_triangle_mesh_3<Kernel>& mesh) {
  constexpr std::size_t header_size = 80;
  std::string header = "binary STL made by equiaffine";
  header.resize(header_size, ' ');
  internal::Buffered_output out(stream);
  out << header;
  out.write_binary(std::uint32_t(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = internal::coordinates(mesh.points[triangle[i]]);
    for (const double x : internal::unit_normal(corners)) out.write_binary(float(x));
    for (const auto& corner : corners)
      for (const double x : corner) out.write_binary(float(x));
    out.write_binary(std::uint16_t(0));
  }
  out.flush();
}

/// Writes the mesh in the format asked for, with those attributes that the format holds.
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
