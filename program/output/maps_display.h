// SPDX-License-Identifier: GPL-3.0-or-later
// Maps on pages and pictures: arrows, planes, axes, and texts.
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_MAPS_DISPLAY_H
#define EQUIAFFINE_PROGRAM_OUTPUT_MAPS_DISPLAY_H

#include "output/displays.h"
#include "output/maps.h"
#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/registration/affine_symmetries.h>

#include <vector>

namespace equiaffine {

/// An arrow from a point along a vector, as a closed mesh: a shaft of the radius, and a cone for the last quarter.
Indexed_triangle_mesh_3<Kernel> arrow_mesh(const Kernel::Point_3& base, const Kernel::Vector_3& arrow, double radius);

/// The fixed planes and axes of symmetries.
struct Symmetry_marks {
  std::vector<Kernel::Plane_3> planes; ///< of reflections, which need not be orthogonal
  std::vector<Kernel::Line_3> axes;    ///< of rotations, each once
};

Symmetry_marks marks_of(const Affine_symmetries_3<Kernel>& symmetries);

/// The intersection curves of planes with the surface, as a mesh of rods.
Indexed_triangle_mesh_3<Kernel> mesh_of_planes(const std::vector<Kernel::Plane_3>& planes,
                                               const Indexed_triangle_mesh_3<Kernel>& surface, double radius);

/// The axes as rods that stick out of the surface.
Indexed_triangle_mesh_3<Kernel> mesh_of_axes(const std::vector<Kernel::Line_3>& axes,
                                             const Indexed_triangle_mesh_3<Kernel>& surface, double radius);

/// The display options: the two surfaces get different colors unless an attribute or a range is given.
Display_request display_of(const Registration_report& report, Display_request options);

/// The texts of the page and the picture.
Description description_of(const Registration_report& report, const Display_request& options);
std::vector<Surface_note> notes_of(const Registration_report& report, const Display_request& options);

/// The same for symmetries, with planes and axes.
Display_request display_of(const Symmetries_report& report, Display_request options);
Description description_of(const Symmetries_report& report, const Display_request& options);
std::vector<Surface_note> notes_of(const Symmetries_report& report, const Display_request& options);

} // namespace equiaffine

#endif
