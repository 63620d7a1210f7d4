// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_PLY_H
#define EQUIAFFINE_IO_READ_PLY_H

#include <equiaffine/io/internal/mesh_readers.h>
#include <equiaffine/mesh/Annotated_mesh_3.h>

#include <istream>
#include <string>

namespace equiaffine {

/// Reads PLY (text or binary): the points, every other scalar property of the vertices as a column, `uchar status` as
/// the status, the comments, and the faces, if any, cut into triangles. Lists at vertices and other elements are left
/// out. `name` stands for the file in messages. Throws `Input_error` for what is not a complete PLY file.
template <class Kernel>
Annotated_mesh_3<Kernel> read_PLY(std::istream& stream, const std::string& name) {
  Annotated_mesh_3<Kernel> result;
  result.attributes = internal::read_PLY_elements(stream, name, internal::receiver_of(result.mesh));
  return result;
}

} // namespace equiaffine

#endif
