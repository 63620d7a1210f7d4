// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_OFF_H
#define EQUIAFFINE_IO_READ_OFF_H

#include <equiaffine/io/internal/Off_scanner.h>
#include <equiaffine/io/internal/text_input.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>
#include <equiaffine/surface/internal/shared/triangles_of_polygon.h>

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace equiaffine {

/// Reads OFF as text, a line for each vertex and face: points and faces, the latter cut into triangles. Normals and
/// colors are left out. `name` stands for the file in messages. Throws `Input_error` for what is not a complete file.
template <class Kernel>
Indexed_triangle_mesh_3<Kernel> read_OFF(std::istream& stream, const std::string& name) {
  const std::string text = internal::read_all(stream);
  internal::Off_scanner scanner(text, name);
  const auto [vertices, faces] = scanner.read_header();
  Indexed_triangle_mesh_3<Kernel> mesh;
  mesh.points.reserve(vertices);
  mesh.triangles.reserve(faces);
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto [x, y, z] = scanner.read_vertex();
    mesh.points.emplace_back(x, y, z);
  }
  std::vector<std::uint32_t> face;
  for (std::size_t f = 0; f < faces; ++f) {
    scanner.read_face(vertices, face);
    add_triangles_of_polygon(mesh.points, face, mesh.triangles);
  }
  return mesh;
}

} // namespace equiaffine

#endif
