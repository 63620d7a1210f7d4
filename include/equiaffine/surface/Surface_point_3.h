// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_SURFACE_POINT_3_H
#define EQUIAFFINE_SURFACE_SURFACE_POINT_3_H

#include <cstddef>

namespace equiaffine {

/// A point sought on the zero set of f, and what it took.
template <class Kernel>
struct Surface_point_3 {
  typename Kernel::Point_3 point;
  bool has_converged;      ///< false: no zero was found, `point` is the best guess
  std::size_t evaluations; ///< of f with its gradient
};

} // namespace equiaffine

#endif
