// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FUNCTION_SURFACE_POINT_3_H
#define EQUIAFFINE_FUNCTION_SURFACE_POINT_3_H

#include <cstddef>

namespace equiaffine {

/// The result of a search for a point on the zero set of f.
template <class Kernel>
struct Surface_point_3 {
  typename Kernel::Point_3 point; ///< the zero
  bool has_converged;             ///< if false, no zero was found, and `point` is the best guess
  std::size_t evaluations;        ///< the number of evaluations of f with its gradient
  bool is_at_pole = false;        ///< no zero was found since f changes its sign at a pole or a jump, which is `point`
  bool is_at_end = false;         ///< no zero was found since f, or its derivatives, end beside `point`
};

} // namespace equiaffine

#endif
