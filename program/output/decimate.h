// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_DECIMATE_H
#define EQUIAFFINE_PROGRAM_OUTPUT_DECIMATE_H

#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <cstddef>

namespace equiaffine {

/// A mesh that is to be looked at, and the numbers at its vertices.
struct Displayed_mesh {
  Indexed_triangle_mesh_3<Kernel> mesh;
  Vertex_attributes attributes;
};

/// Makes a mesh of at most so many triangles, for display: of the vertices in a cell of a grid one is left, that
/// nearest to their mean, with its numbers (vertex clustering: Rossignac, Borrel 1993). Parts that are nearer to each
/// other than a cell may be merged, and triangles with a corner that is not finite are left out. There are at
/// most 2^21 cells along an axis: one vertex a thousand times as far away as the others makes the mesh coarse. Takes
/// about 70 bytes of memory per vertex.
Displayed_mesh decimate(const Indexed_triangle_mesh_3<Kernel>& mesh, const Vertex_attributes& attributes,
                        std::size_t most_triangles);

} // namespace equiaffine

#endif
