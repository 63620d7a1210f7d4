// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_ACUTE_GRADIENTS_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_ACUTE_GRADIENTS_H

#include <equiaffine/function/capabilities.h>

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace equiaffine::internal {

/// Whether any two gradients that `jet` bounds have projections to the plane or line of some axes that form an acute
/// angle.
inline bool has_acute_gradients(const Jet_3<Interval, 1>& jet, const std::array<bool, 3>& axes) {
  double largest = 0;
  for (std::size_t a = 0; a < 3; ++a) largest = std::max(largest, abs(jet.coefficients()[1 + a]).upper());
  if (!(largest > 0 && std::isfinite(largest))) return false;
  const Interval scale(std::ldexp(1.0, -std::ilogb(largest))); // so that no product overflows or underflows
  Interval product(0);
  for (std::size_t a = 0; a < 3; ++a) {
    const Interval g = jet.coefficients()[1 + a] * scale, independent = g; // bounds of two gradients, not of one twice
    if (axes[a]) product += g * independent;
  }
  return product.lower() > 0;
}

/// A face, an edge or a corner of a cell, or the cell itself: its extent along each axis.
struct Cell_side_3 {
  enum Extent { WHOLE, LOWER, UPPER };
  std::array<Extent, 3> extents;

  /// Side n of the 27, of which number 0 is the cell itself.
  static Cell_side_3 number(int n) { return {{Extent(n % 3), Extent(n / 3 % 3), Extent(n / 9)}}; }

  std::array<bool, 3> axes() const {
    return {extents[0] == WHOLE, extents[1] == WHOLE, extents[2] == WHOLE}; // the axes along which this part extends
  }

  bool is_corner() const { return axes() == std::array<bool, 3>{false, false, false}; }

  CGAL::Bbox_3 box(const CGAL::Bbox_3& cell) const {
    std::array<double, 3> lower, upper;
    for (int a = 0; a < 3; ++a) {
      lower[std::size_t(a)] = extents[std::size_t(a)] == UPPER ? cell.max(a) : cell.min(a);
      upper[std::size_t(a)] = extents[std::size_t(a)] == LOWER ? cell.min(a) : cell.max(a);
    }
    return CGAL::Bbox_3(lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]);
  }

  /// Whether this part of a cell lies in the same side of another box.
  bool touches(const CGAL::Bbox_3& cell, const CGAL::Bbox_3& outer) const {
    for (int a = 0; a < 3; ++a) {
      const Extent extent = extents[std::size_t(a)];
      if (extent == LOWER && cell.min(a) != outer.min(a)) return false;
      if (extent == UPPER && cell.max(a) != outer.max(a)) return false;
    }
    return true;
  }
};

/// Whether any two gradients in a cell form an acute angle, and so do their projections to every face and edge of the
/// outer box that the cell touches and the surface meets. `jet` bounds f on the cell.
template <ImplicitFunctionTraits_3 Traits>
bool has_acute_gradients(const Traits& traits, const Jet_3<Interval, 1>& jet, const CGAL::Bbox_3& cell,
                         const CGAL::Bbox_3& outer) {
  if (!has_acute_gradients(jet, {true, true, true})) return false;
  for (int n = 1; n < 27; ++n) {
    const auto side = Cell_side_3::number(n);
    if (side.is_corner() || !side.touches(cell, outer) || has_acute_gradients(jet, side.axes())) continue;
    const auto jet_there = tight_first_order_bounds(traits, side.box(cell));
    if (jet_there.value().contains(0) && !has_acute_gradients(jet_there, side.axes())) return false;
  }
  return true;
}

} // namespace equiaffine::internal

#endif
