// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_LINE_SEARCH_H
#define EQUIAFFINE_SURFACE_INTERNAL_LINE_SEARCH_H

#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/function/internal/sign_change.h>
#include <equiaffine/surface/distance_estimate.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine::internal {

/// Looks for a change of sign on the way from p along the gradient towards the surface, at twice the estimated
/// distance, then twice as far each time up to `maximal_distance`.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> search_along_gradient(const Traits& traits, const typename Traits::Point_3& p,
                                                         const typename Traits::FT& maximal_distance,
                                                         const Jet_3<typename Traits::FT, 1>& jet) {
  using FT = typename Traits::FT;
  using std::abs;
  using std::sqrt;
  const auto& c = jet.coefficients();
  const FT magnitude = std::max({abs(p.x()), abs(p.y()), abs(p.z()), maximal_distance});
  const FT rounding = FT(4) * std::numeric_limits<FT>::epsilon() * magnitude;
  const FT distance = distance_estimate(jet);
  if (distance <= rounding) return {p, true, 0}; // no point of the line is nearer, and signs there are noise
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
    if (!(value == value)) break; // f is undefined there
    if (!is_sign_change(c[0], value)) continue;
    auto result = intersect_segment(traits, p, end, c[0], value);
    result.evaluations += evaluations;
    return result;
  }
  return {p, false, evaluations};
}

} // namespace equiaffine::internal

#endif
