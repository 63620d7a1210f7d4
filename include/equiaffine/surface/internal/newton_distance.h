// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_INTERNAL_NEWTON_DISTANCE_H
#define EQUIAFFINE_SURFACE_INTERNAL_NEWTON_DISTANCE_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/surface/curve_step.h>
#include <equiaffine/surface/distance_estimate.h>
#include <equiaffine/surface/sign_change.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// Whether a step of Newton's method from p does not lead to a zero, though `distance`, its length, is positive. To a
/// zero of order m, f changes its sign or shrinks by the factor (1 - 1/m)^m, which is less than 1/e. Away from a pole
/// of order n it keeps its sign and shrinks by (1 + 1/n)^-n, which is more. Where the step is shorter than
/// `resolvable`, rounding decides its end, and one much longer is taken: beyond a zero f grows, away from a pole it
/// shrinks. Nothing is concluded where f is undefined at the end.
template <ImplicitFunctionTraits_3 Traits>
bool leads_away_from_zeros(const Traits& traits, const typename Traits::Point_3& p,
                           const Jet_3<typename Traits::FT, 1>& jet, const typename Traits::FT& distance,
                           const typename Traits::FT& resolvable) {
  using FT = typename Traits::FT;
  using Vector_3 = typename Traits::Vector_3;
  using std::abs;
  using std::sqrt;
  constexpr double longer = 16;
  const auto& c = jet.coefficients();
  const bool is_short = distance < resolvable;
  const FT length = is_short ? FT(longer) * resolvable : distance;
  const Vector_3 slope = gradient_of<Vector_3>(jet) / std::max({abs(c[1]), abs(c[2]), abs(c[3])}); // cannot overflow
  const FT towards_zero = (c[0] > FT(0) ? -length : length) / sqrt(slope.squared_length());
  const FT here = abs(c[0]), value = traits.value(p + towards_zero * slope), there = abs(value);
  if (is_sign_change(c[0], value)) return false;
  return is_short ? there < here : there > here / FT(std::numbers::e);
}

/// The algorithm of `max_distance_to_surface`.
template <class ConcurrencyTag, ImplicitFunctionTraits_3 Traits>
typename Traits::FT max_distance_to_surface(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                            std::span<const Point_status> status) {
  using FT = typename Traits::FT;
  using std::abs;
  using std::sqrt;
  FT coordinate(0);
  for (const auto& p : points) coordinate = std::max({coordinate, abs(p.x()), abs(p.y()), abs(p.z())});
  const FT resolvable = sqrt(std::numeric_limits<FT>::epsilon()) * coordinate;
  struct Distance {
    FT value;
    bool is_false;
  };
  std::vector<Distance> distances(points.size());
  parallel_for<ConcurrencyTag>(
      0, points.size(),
      [&](std::size_t i) {
        const auto jet = first_order(traits, points[i]);
        const FT distance = distance_estimate(jet);
        distances[i] = {distance,
                        distance > FT(0) && leads_away_from_zeros(traits, points[i], jet, distance, resolvable)};
      },
      256);
  constexpr FT unknown = std::numeric_limits<FT>::quiet_NaN();
  FT greatest = unknown;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (!status.empty() && status[i] == Point_status::UNCONVERGED) continue;
    if (distances[i].is_false) return unknown;
    if (!(distances[i].value <= greatest) && distances[i].value == distances[i].value) greatest = distances[i].value;
  }
  return greatest;
}

} // namespace equiaffine::internal

#endif
