// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_BOX_INTERVALS_H
#define EQUIAFFINE_FUNCTION_INTERNAL_BOX_INTERVALS_H

#include <equiaffine/number/Interval.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>

namespace equiaffine::internal {

/// The intervals of x, y and z over a box.
inline std::array<Interval, 3> sides_of(const CGAL::Bbox_3& box) {
  return {Interval(box.xmin(), box.xmax()), Interval(box.ymin(), box.ymax()), Interval(box.zmin(), box.zmax())};
}

inline std::array<double, 3> center_of(const CGAL::Bbox_3& box) {
  return {(box.xmin() + box.xmax()) / 2, (box.ymin() + box.ymax()) / 2, (box.zmin() + box.zmax()) / 2};
}

/// The box that contains the point only.
inline CGAL::Bbox_3 box_of_point(const std::array<double, 3>& p) {
  return CGAL::Bbox_3(p[0], p[1], p[2], p[0], p[1], p[2]);
}

/// The intervals of the vectors from the center to the points of a box.
inline std::array<Interval, 3> offset_from_center(const CGAL::Bbox_3& box, const std::array<double, 3>& center) {
  std::array<Interval, 3> offset = sides_of(box);
  for (std::size_t axis = 0; axis < 3; ++axis) offset[axis] = offset[axis] - Interval(center[axis]);
  return offset;
}

} // namespace equiaffine::internal

#endif
