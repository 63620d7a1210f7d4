// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_INNER_VERTEX_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_INNER_VERTEX_H

#include <equiaffine/function/internal/sign_change.h>
#include <equiaffine/marching_cubes/internal/cell_polygons.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace equiaffine::internal {

/// Value and partial derivative along `axis` of the trilinear interpolant of f at p in the unit cell.
template <class FT>
std::pair<FT, FT> trilinear(const std::array<FT, 8>& f, const std::array<FT, 3>& p, std::size_t axis) {
  std::array<FT, 2> ends{FT(0), FT(0)};
  for (std::size_t c = 0; c < 8; ++c) {
    FT weight(1);
    for (std::size_t a = 0; a < 3; ++a)
      if (a != axis) weight *= c >> a & 1 ? p[a] : FT(1) - p[a];
    ends[c >> axis & 1] += weight * f[c];
  }
  const FT slope = ends[1] - ends[0];
  return {ends[0] + p[axis] * slope, slope};
}

/// The place of a vertex amid those on some edges of a cell, in the coordinates of the cell: their mean, moved along
/// the axis of the steepest slope onto the surface of the trilinear interpolant if that is within the cell.
template <class FT>
std::array<FT, 3> inner_vertex(const std::array<FT, 8>& f, std::span<const std::uint8_t> edges) {
  using std::abs;
  std::array<FT, 3> p{FT(0), FT(0), FT(0)};
  for (const int edge : edges) {
    const int c = first_corner(edge);
    const FT t = linear_zero(f[std::size_t(c)], f[std::size_t(second_corner(edge))]);
    for (int a = 0; a < 3; ++a) p[std::size_t(a)] += edge / 4 == a ? t : FT(c >> a & 1);
  }
  for (FT& x : p) x /= FT(double(edges.size()));
  std::size_t steepest = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (abs(trilinear(f, p, a).second) > abs(trilinear(f, p, steepest).second)) steepest = a;
  const auto [value, slope] = trilinear(f, p, steepest);
  const FT moved = p[steepest] - value / slope;
  if (moved > FT(0) && moved < FT(1)) p[steepest] = moved;
  return p;
}

} // namespace equiaffine::internal

#endif
