// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_CHECK_DELAUNAY_SURFACE_H
#define EQUIAFFINE_PROGRAM_COMMANDS_CHECK_DELAUNAY_SURFACE_H

#include <CGAL/Bbox_3.h>

namespace equiaffine {

/// Throws `Input_error` if `delaunay_surface` would refuse the box.
void check_box_of_delaunay_surface(const CGAL::Bbox_3& box);

/// Throws `Input_error` if `delaunay_surface` would refuse the radius.
void check_radius_of_delaunay_surface(const CGAL::Bbox_3& box, double radius);

} // namespace equiaffine

#endif
