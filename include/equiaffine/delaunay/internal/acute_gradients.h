// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_ACUTE_GRADIENTS_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_ACUTE_GRADIENTS_H

#include <equiaffine/function/first_order_bounds.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace equiaffine::internal {

/// Whether the projections to some axes of any two gradients in a box have a positive product.
inline bool has_acute_gradients(const Jet_3<Interval, 1>& jet, const std::array<bool, 3>& axes) {
  double largest = 0;
  for (std::size_t a = 0; a < 3; ++a) largest = std::max(largest, abs(jet.coefficients()[1 + a]).upper());
  if (!(largest > 0 && std::isfinite(largest))) return false;
  const Interval scale(std::ldexp(1.0, -std::ilogb(largest))); // so that no product over- or underflows
  Interval product(0);
  for (std::size_t a = 0; a < 3; ++a) {
    const Interval g = jet.coefficients()[1 + a] * scale, independent = g;
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
  enum Side { ALL, LOWER, UPPER };
  for (int part = 1; part < 27; ++part) { // along each axis all of the cell, or its lower or upper side
    const std::array<int, 3> side = {part % 3, part / 3 % 3, part / 9};
    std::array<double, 3> lower, upper;
    std::array<bool, 3> is_free;
    bool is_border = true;
    for (int a = 0; a < 3; ++a) {
      const auto n = std::size_t(a);
      is_free[n] = side[n] == ALL;
      lower[n] = side[n] == UPPER ? cell.max(a) : cell.min(a);
      upper[n] = side[n] == LOWER ? cell.min(a) : cell.max(a);
      is_border = is_border && (is_free[n] || lower[n] == (side[n] == LOWER ? outer.min(a) : outer.max(a)));
    }
    const bool is_corner = !is_free[0] && !is_free[1] && !is_free[2];
    if (!is_border || is_corner || has_acute_gradients(jet, is_free)) continue;
    const CGAL::Bbox_3 box(lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]);
    const auto jet_there = tight_first_order_bounds(traits, box);
    if (jet_there.value().contains(0) && !has_acute_gradients(jet_there, is_free)) return false;
  }
  return true;
}

} // namespace equiaffine::internal

#endif
