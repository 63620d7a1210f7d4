// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_INTERNAL_CHOOSE_PIVOT_H
#define EQUIAFFINE_GEOMETRY_INTERNAL_CHOOSE_PIVOT_H

#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/select.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine::internal {

/// The axis that takes the part of z in a chart.
template <class FT>
struct Pivot_3 {
  Mask_of<FT> is_x, is_y;
  std::array<FT, 3> reciprocals; ///< 1 / f_i for all three axes
};

/// Chooses the axis whose largest |f_ij| / |f_i f_j| is smallest. An axis with f_j = 0 does not count. Among equals it is
/// that with the largest |f_i|.
///
/// Two axes are compared without the curvature that they share: x with y without xy, then the better one with z.
template <class FT>
[[gnu::always_inline]] inline Pivot_3<FT> choose_pivot(const Jet_3<FT>& jet) {
  using std::abs;
  const auto& c = jet.coefficients();
  const std::array<FT, 3> slope = {abs(c[1]), abs(c[2]), abs(c[3])};
  const std::array<FT, 3> reciprocals = {FT(1) / c[1], FT(1) / c[2], FT(1) / c[3]};
  std::array<Mask_of<FT>, 3> counts;
  std::array<FT, 3> r; // the reciprocals, 0 for an axis that does not count
  for (std::size_t i = 0; i < 3; ++i) {
    counts[i] = slope[i] >= FT(std::numeric_limits<FT>::min());
    r[i] = select(counts[i], reciprocals[i], FT(0));
  }
  const auto larger = [](const FT& x, const FT& y) { return select(x > y, x, y); };
  const auto curvature = [&](std::size_t monomial, std::size_t i, std::size_t j) {
    return FT(abs(c[monomial] * r[i] * r[j]));
  };
  const FT never(std::numeric_limits<FT>::infinity());
  const FT xy = curvature(5, 0, 1), xz = curvature(6, 0, 2), yz = curvature(8, 1, 2);
  const FT xx = select(counts[0], FT(FT(2) * curvature(4, 0, 0)), never);
  const FT yy = select(counts[1], FT(FT(2) * curvature(7, 1, 1)), never);
  const FT zz = select(counts[2], FT(FT(2) * curvature(9, 2, 2)), never);

  const FT x = larger(xx, xz), y = larger(yy, yz);
  const Mask_of<FT> x_beats_y = x < y || (x == y && slope[0] > slope[1]);
  const FT winner = larger(select(x_beats_y, xx, yy), xy), z = larger(zz, select(x_beats_y, yz, xz));
  const FT slope_of_winner = select(x_beats_y, slope[0], slope[1]);
  const Mask_of<FT> winner_beats_z = winner < z || (winner == z && slope_of_winner > slope[2]);
  return {x_beats_y && winner_beats_z, !x_beats_y && winner_beats_z, reciprocals};
}

} // namespace equiaffine::internal

#endif
