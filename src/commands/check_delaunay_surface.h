// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_COMMANDS_CHECK_DELAUNAY_SURFACE_H
#define EQUIAFFINE_SRC_COMMANDS_CHECK_DELAUNAY_SURFACE_H

#include <CGAL/Bbox_3.h>

namespace equiaffine {

/// Throws `Input_error` if the box is too large or too small: the mesher computes polynomials of degree 6 in lengths,
/// which must neither overflow nor underflow.
void check_box_of_delaunay_surface(const CGAL::Bbox_3& box, double diagonal);

/// Throws `Input_error` if facets would be smaller than about a thousand units in the last place of the coordinates, since
/// rounding would spoil their shape.
void check_radius_of_delaunay_surface(const CGAL::Bbox_3& box, double radius);

} // namespace equiaffine

#endif
