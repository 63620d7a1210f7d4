// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_ADD_FACE_H
#define EQUIAFFINE_IO_INTERNAL_ADD_FACE_H

#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// Appends a face as a fan of triangles around its first vertex.
template <class Kernel>
void add_face(Indexed_triangle_mesh_3<Kernel>& mesh, const std::vector<std::uint32_t>& face) {
  for (std::size_t i = 2; i < face.size(); ++i) mesh.triangles.push_back({face[0], face[i - 1], face[i]});
}

} // namespace equiaffine::internal

#endif
