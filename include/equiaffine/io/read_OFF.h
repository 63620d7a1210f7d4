// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_OFF_H
#define EQUIAFFINE_IO_READ_OFF_H

#include <equiaffine/io/internal/off_elements.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <istream>
#include <string>

namespace equiaffine {

/// Reads OFF as text, a line for each vertex and face: points and faces, the latter cut into triangles. Normals and
/// colors are left out. `name` stands for the file in messages. Throws `Input_error` for what is not a complete file.
template <class Kernel>
Indexed_triangle_mesh_3<Kernel> read_OFF(std::istream& stream, const std::string& name) {
  return internal::read_OFF_with<Kernel>(
      stream, name, [](auto& mesh, const auto& face) { add_triangles_of_polygon(mesh.points, face, mesh.triangles); });
}

} // namespace equiaffine

#endif
