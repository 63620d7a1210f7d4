// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_PLY_H
#define EQUIAFFINE_IO_READ_PLY_H

#include <equiaffine/io/internal/ply_elements.h>
#include <equiaffine/mesh/Annotated_mesh_3.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <istream>
#include <string>

namespace equiaffine {

/// Reads PLY (text or binary): the points, every other scalar property of the vertices as a column, `uchar status` as
/// the status, the comments, and the faces, if any, cut into triangles. Lists at vertices and other elements are left
/// out. `name` stands for the file in messages. Throws `Input_error` for what is not a complete PLY file.
template <class Kernel>
Annotated_mesh_3<Kernel> read_PLY(std::istream& stream, const std::string& name) {
  return internal::read_PLY_with<Kernel>(
      stream, name, [](auto& mesh, const auto& face) { add_triangles_of_polygon(mesh.points, face, mesh.triangles); });
}

} // namespace equiaffine

#endif
