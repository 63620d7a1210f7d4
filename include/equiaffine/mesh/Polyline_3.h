// SPDX-License-Identifier: GPL-3.0-or-later
// A chain of points, closed or not.
#ifndef EQUIAFFINE_MESH_POLYLINE_3_H
#define EQUIAFFINE_MESH_POLYLINE_3_H

#include <vector>

namespace equiaffine {

/// A closed polyline does not repeat its first point.
template <class Kernel>
struct Polyline_3 {
  std::vector<typename Kernel::Point_3> points; ///< in their order
  bool is_closed = false;                       ///< whether the first point follows the last one
};

} // namespace equiaffine

#endif
