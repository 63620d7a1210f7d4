// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_GEOMETRY_AFFINE_AREA_DENSITY_H
#define EQUIAFFINE_GEOMETRY_AFFINE_AREA_DENSITY_H

#include <equiaffine/number/internal/elementary_functions.h>

#include <array>
#include <cmath>
#include <numbers>

namespace equiaffine {

/// The affine area per Euclidean area, |K_e|^(1/4): the integral of it over a part of the surface does not change under
/// affine maps of determinant 1. It is the length of 1 / nu, needs derivatives of order 2 only, and is 0 at a parabolic
/// point. Unit: length^(-1/2).
template <class FT>
FT affine_area_density(const FT& gaussian_curvature) {
  using std::abs;
  using std::sqrt;
  return sqrt(sqrt(abs(gaussian_curvature)));
}

/// The angle between two vectors in degrees, from 0 to 180.
template <class FT>
FT angle_in_degrees(const std::array<FT, 3>& v, const std::array<FT, 3>& w) {
  using std::atan2;
  using std::sqrt;
  const FT x = v[1] * w[2] - v[2] * w[1], y = v[2] * w[0] - v[0] * w[2], z = v[0] * w[1] - v[1] * w[0];
  return atan2(sqrt(x * x + y * y + z * z), v[0] * w[0] + v[1] * w[1] + v[2] * w[2]) * FT(180 / std::numbers::pi);
}

} // namespace equiaffine

#endif
