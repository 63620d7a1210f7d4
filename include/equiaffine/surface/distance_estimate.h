// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_DISTANCE_ESTIMATE_H
#define EQUIAFFINE_SURFACE_DISTANCE_ESTIMATE_H

#include <equiaffine/number/Jet_3.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace equiaffine {

/// |f| / |grad f|: to first order the distance from a point to the zero set. It is 0 where f is 0, infinite where only
/// the gradient is 0, and NaN where f is undefined.
template <class FT>
FT distance_estimate(const Jet_3<FT, 1>& jet) {
  using std::abs;
  using std::sqrt;
  const auto& c = jet.coefficients();
  const FT scale = std::max({abs(c[1]), abs(c[2]), abs(c[3])});
  if (c[0] == FT(0)) return FT(0);
  if (scale == FT(0)) return std::numeric_limits<FT>::infinity();
  const FT x = c[1] / scale, y = c[2] / scale, z = c[3] / scale;
  return abs(c[0]) / scale / sqrt(x * x + y * y + z * z);
}

} // namespace equiaffine

#endif
