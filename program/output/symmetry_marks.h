// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_SYMMETRY_MARKS_H
#define EQUIAFFINE_PROGRAM_OUTPUT_SYMMETRY_MARKS_H

#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/registration/Affine_symmetries_3.h>

#include <vector>

namespace equiaffine {

/// What symmetries leave in its place.
struct Symmetry_marks {
  std::vector<Kernel::Plane_3> planes; ///< of reflections, which need not be perpendicular
  std::vector<Kernel::Line_3> axes;    ///< of rotations, each once
};

Symmetry_marks marks_of(const Affine_symmetries_3<Kernel>& symmetries);

/// The curves in which planes cut the surface, as a mesh of rods.
Indexed_triangle_mesh_3<Kernel> mesh_of_planes(const std::vector<Kernel::Plane_3>& planes,
                                               const Indexed_triangle_mesh_3<Kernel>& surface, double radius);

/// The axes as rods that stick out of the surface.
Indexed_triangle_mesh_3<Kernel> mesh_of_axes(const std::vector<Kernel::Line_3>& axes,
                                             const Indexed_triangle_mesh_3<Kernel>& surface, double radius);

} // namespace equiaffine

#endif
