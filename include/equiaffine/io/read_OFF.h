// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_OFF_H
#define EQUIAFFINE_IO_READ_OFF_H

#include <equiaffine/io/internal/mesh_readers.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <istream>
#include <string>

namespace equiaffine {

/// Reads OFF as text, a line for each vertex and face: points and faces, the latter cut into triangles. Normals and
/// colors are left out. `name` stands for the file in messages. Throws `Input_error` for what is not a complete file.
template <class Kernel>
Indexed_triangle_mesh_3<Kernel> read_OFF(std::istream& stream, const std::string& name) {
  Indexed_triangle_mesh_3<Kernel> mesh;
  internal::read_OFF_elements(stream, name, internal::receiver_of(mesh));
  return mesh;
}

} // namespace equiaffine

#endif
