// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FORMULA_INTERNAL_CENTERED_BOX_H
#define EQUIAFFINE_FORMULA_INTERNAL_CENTERED_BOX_H

#include <equiaffine/base/internal/check_flags.h>

#include <CGAL/Bbox_3.h>

namespace equiaffine::internal {

/// The box about the origin with the given half sides.
inline CGAL::Bbox_3 centered_box(double x, double y, double z) { return CGAL::Bbox_3(-x, -y, -z, x, y, z); }

/// The cube about the origin with the given half side.
inline CGAL::Bbox_3 centered_cube(double half_side) { return centered_box(half_side, half_side, half_side); }

} // namespace equiaffine::internal

#endif
