// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_ARROW_MESH_H
#define EQUIAFFINE_PROGRAM_OUTPUT_ARROW_MESH_H

#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

namespace equiaffine {

/// An arrow from a point along a vector, as a closed mesh: a shaft of that radius, and a cone for the last quarter.
Indexed_triangle_mesh_3<Kernel> arrow_mesh(const Kernel::Point_3& base, const Kernel::Vector_3& arrow, double radius);

/// A rod between two points, as a closed mesh.
Indexed_triangle_mesh_3<Kernel> rod_mesh(const Kernel::Point_3& from, const Kernel::Point_3& to, double radius);

} // namespace equiaffine

#endif
