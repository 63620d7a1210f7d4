// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_EXTENT_OF_FIT_H
#define EQUIAFFINE_FIT_INTERNAL_EXTENT_OF_FIT_H

namespace equiaffine {

/// The diagonals of boxes of points whose curvatures fits give: affine curvatures, and what they are computed from, leave
/// double precision in other units, where the function of a fit still exists. Points that are all equal have no curvatures in any unit.
struct Extent_of_fit {
  static constexpr double least = 1e-40, greatest = 1e40;

  static constexpr bool has(double diagonal) { return diagonal == 0 || (least <= diagonal && diagonal <= greatest); }
};

} // namespace equiaffine

#endif
