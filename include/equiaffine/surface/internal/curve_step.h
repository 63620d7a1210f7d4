// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_CURVE_STEP_H
#define EQUIAFFINE_SURFACE_INTERNAL_CURVE_STEP_H

#include <equiaffine/surface/internal/jet_derivatives.h>

#include <algorithm>
#include <cmath>

namespace equiaffine {

/// The shortest step of Newton's method to the curve f = g = 0, from the jets of f and g at a point; not finite where
/// the gradients are parallel.
template <class Vector_3, class Jet_f, class Jet_g>
Vector_3 step_to_curve(const Jet_f& f, const Jet_g& g) {
  // Gradients are scaled so that no product of four of them overflows or underflows.
  const auto scale_of = [](const auto& jet) {
    const auto& c = jet.coefficients();
    using std::abs;
    return std::max({abs(c[1]), abs(c[2]), abs(c[3])});
  };
  const auto s = scale_of(f), t = scale_of(g);
  const Vector_3 u = gradient_of<Vector_3>(f) / s, v = gradient_of<Vector_3>(g) / t;
  const auto a = f.value() / s, b = g.value() / t;
  const auto uu = u * u, uv = u * v, vv = v * v, determinant = uu * vv - uv * uv;
  return (uv * b - vv * a) / determinant * u + (uv * a - uu * b) / determinant * v;
}

} // namespace equiaffine

#endif
