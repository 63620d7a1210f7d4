// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_OFF_ELEMENTS_H
#define EQUIAFFINE_IO_INTERNAL_OFF_ELEMENTS_H

#include <equiaffine/io/internal/Off_scanner.h>
#include <equiaffine/io/internal/text_input.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace equiaffine::internal {

/// Reads OFF, and calls `add_face(mesh, face)` for each face, a vector of positions of points.
template <class Kernel, class Add_face>
Indexed_triangle_mesh_3<Kernel> read_OFF_with(std::istream& stream, const std::string& name, const Add_face& add_face) {
  const std::string text = read_all(stream);
  Off_scanner scanner(text, name);
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
    add_face(mesh, face);
  }
  return mesh;
}

} // namespace equiaffine::internal

#endif
