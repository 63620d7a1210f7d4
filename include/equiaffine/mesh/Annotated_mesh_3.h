// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_ANNOTATED_MESH_3_H
#define EQUIAFFINE_MESH_ANNOTATED_MESH_3_H

#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

namespace equiaffine {

/// A mesh, or points alone, with the numbers that came with the points.
template <class Kernel>
struct Annotated_mesh_3 {
  Indexed_triangle_mesh_3<Kernel> mesh; ///< has no triangles if there are points alone
  Vertex_attributes attributes;         ///< columns, status and comments
};

} // namespace equiaffine

#endif
