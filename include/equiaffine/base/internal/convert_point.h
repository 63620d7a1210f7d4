// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_CONVERT_POINT_H
#define EQUIAFFINE_BASE_INTERNAL_CONVERT_POINT_H

#include <CGAL/number_utils.h>

namespace equiaffine {

/// The point of another kernel with the same coordinates, rounded to double.
template <class Kernel, class Point_3>
typename Kernel::Point_3 convert_point(const Point_3& p) {
  return typename Kernel::Point_3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
}

} // namespace equiaffine

#endif
