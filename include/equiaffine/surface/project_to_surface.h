// SPDX-License-Identifier: GPL-3.0-or-later
// Projects points onto the zero set of a function along its gradient.
#ifndef EQUIAFFINE_SURFACE_PROJECT_TO_SURFACE_H
#define EQUIAFFINE_SURFACE_PROJECT_TO_SURFACE_H

#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/number/Jet_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine {

/// |f| / |grad f|, which is to first order the distance from a point to the zero set. It is 0 if f is 0, infinite if
/// only the gradient is 0, and NaN if f is undefined.
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

/// Finds the zero of f nearest to p on the line through p along the gradient, at most `maximal_distance` away. `jet`
/// is the expansion of f at p, which does not count as an evaluation. Searches for a sign change up to twice the
/// estimated distance, then doubles the distance each time.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> project_to_surface(const Traits& traits, const typename Traits::Point_3& p,
                                                      const typename Traits::FT& maximal_distance,
                                                      const Jet_3<typename Traits::FT, 1>& jet) {
  using FT = typename Traits::FT;
  using std::abs;
  using std::sqrt;
  const auto& c = jet.coefficients();
  const FT magnitude = std::max({abs(p.x()), abs(p.y()), abs(p.z()), maximal_distance});
  const FT rounding = FT(4) * std::numeric_limits<FT>::epsilon() * magnitude;
  const FT distance = distance_estimate(jet);
  if (distance <= rounding) return {p, true, 0}; // no point of the line is nearer: signs there are noise
  const typename Traits::Vector_3 gradient(c[1], c[2], c[3]);
  const FT norm = sqrt(gradient.squared_length());
  const bool is_finite = c[0] - c[0] == FT(0);
  if (!(norm > FT(0)) || !is_finite) return {p, false, 0};
  const auto towards_surface = gradient * ((c[0] > FT(0) ? FT(-1) : FT(1)) / norm);
  std::size_t evaluations = 0;
  FT reach = FT(2) * distance;
  for (bool is_last = false; !is_last; reach = FT(2) * reach) {
    is_last = !(reach < maximal_distance);
    const auto end = p + std::min(reach, maximal_distance) * towards_surface;
    const FT value = traits.value(end);
    ++evaluations;
    if (!(value == value)) break; // f is undefined
    if (!is_sign_change(c[0], value)) continue;
    auto result = intersect_segment(traits, p, end, c[0], value);
    result.evaluations += evaluations;
    return result;
  }
  return {p, false, evaluations};
}

/// The same, but computes the expansion at p, which counts as an evaluation.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> project_to_surface(const Traits& traits, const typename Traits::Point_3& p,
                                                      const typename Traits::FT& maximal_distance) {
  auto result = project_to_surface(traits, p, maximal_distance, first_order(traits, p));
  ++result.evaluations;
  return result;
}

} // namespace equiaffine

#endif
