// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_MESH_READERS_H
#define EQUIAFFINE_IO_INTERNAL_MESH_READERS_H

#include <equiaffine/base/internal/check_flags.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine::internal {

/// What the readers of the library call with the elements of a file, so that a mesh of any kernel can be made of them.
struct Mesh_receiver {
  std::function<void(std::size_t points, std::size_t faces)> reserve; ///< before the points, with what is announced
  std::function<void(double x, double y, double z)> add_point;
  std::function<void(const std::vector<std::uint32_t>& face)> add_face; ///< positions of points that were added
};

/// Adds the points to a mesh, and the faces as triangles.
template <class Kernel>
Mesh_receiver receiver_of(Indexed_triangle_mesh_3<Kernel>& mesh) {
  return {[&](std::size_t points, std::size_t faces) {
            mesh.points.reserve(points);
            mesh.triangles.reserve(faces);
          },
          [&](double x, double y, double z) { mesh.points.emplace_back(x, y, z); },
          [&](const std::vector<std::uint32_t>& face) { add_triangles_of_polygon(mesh.points, face, mesh.triangles); }};
}

/// What a table of points has besides its points.
struct Csv_cells {
  std::vector<std::string> header, cells; ///< the cells are as they were written, row by row
  char separator = ',';
  std::vector<Vertex_attributes::Column> columns; ///< those all of whose cells are numbers
};

// The library defines these functions. `name` stands for the file in messages.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Reads PLY, and returns what comes with the points.
Vertex_attributes read_PLY_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver);

/// Reads OFF.
void read_OFF_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver);

/// Reads XYZ, and returns what comes with the points.
Vertex_attributes read_XYZ_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver);

/// Reads CSV.
Csv_cells read_CSV_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver);

/// The extension of a file that begins with this text: `.ply` or `.off` if the first word says so, otherwise `.csv`.
const char* extension_of_text(std::string_view text);

/// The columns of a file that stay when `attributes` are written beside them: those of other names.
std::vector<std::size_t> columns_to_keep(const std::vector<std::string>& header, const Vertex_attributes& attributes);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

} // namespace equiaffine::internal

#endif
