// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_ACUTE_GRADIENTS_H
#define EQUIAFFINE_INTERNAL_ACUTE_GRADIENTS_H

#include <equiaffine/internal/first_order_bounds.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>

namespace equiaffine::internal {

/// Whether the projections to some axes of any two gradients in a box have a positive product.
inline bool has_acute_gradients(const Jet_3<Interval, 1>& jet, const std::array<bool, 3>& axes) {
  Interval product(0);
  for (std::size_t a = 0; a < 3; ++a) {
    const Interval g = jet.coefficients()[1 + a], independent = g;
    if (axes[a]) product += g * independent;
  }
  return product.lower() > 0;
}

/// Whether any two gradients in a cell form an acute angle, and so do their projections to every face and edge of the
/// outer box that the cell touches and the surface meets. `jet` bounds f on the cell.
template <ImplicitFunctionTraits_3 Traits>
bool has_acute_gradients(const Traits& traits, const Jet_3<Interval, 1>& jet, const CGAL::Bbox_3& cell,
                         const CGAL::Bbox_3& outer) {
  if (!has_acute_gradients(jet, {true, true, true})) return false;
  for (unsigned constant_axes = 1; constant_axes < 7; ++constant_axes) { // one on a face, two on an edge
    std::array<double, 3> lower = {cell.xmin(), cell.ymin(), cell.zmin()};
    std::array<double, 3> upper = {cell.xmax(), cell.ymax(), cell.zmax()};
    std::array<bool, 3> is_free = {true, true, true};
    bool is_border = true;
    for (unsigned a = 0; a < 3; ++a) {
      if (!(constant_axes >> a & 1)) continue;
      is_free[a] = false;
      if (lower[a] == outer.min(int(a))) upper[a] = lower[a];
      else if (upper[a] == outer.max(int(a))) lower[a] = upper[a];
      else is_border = false;
    }
    if (!is_border || has_acute_gradients(jet, is_free)) continue;
    const CGAL::Bbox_3 part(lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]);
    const auto jet_there = tight_first_order_bounds(traits, part);
    if (jet_there.value().contains(0) && !has_acute_gradients(jet_there, is_free)) return false;
  }
  return true;
}

} // namespace equiaffine::internal

#endif
