// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROJECT_TO_SURFACE_H
#define EQUIAFFINE_PROJECT_TO_SURFACE_H

#include <equiaffine/concepts.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine {

/// A point sought on the zero set of f, and what it took.
template <class Kernel>
struct Surface_point_3 {
  typename Kernel::Point_3 point;
  bool has_converged;      ///< false: no zero was found, `point` is the best guess
  std::size_t evaluations; ///< of f with its gradient
};

/// |f| / |grad f|: to first order the distance from a point to the zero set. 0 where f is 0, infinite where only the
/// gradient vanishes, NaN where f is undefined.
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

/// A zero of f on the segment ab, at whose ends f has the values fa and fb of different signs (0 counts as positive).
/// Newton's method on the restriction of f, started at the linear interpolation and kept within the bracket by
/// bisection whenever a step would leave it or not halve the last one (Press et al., Numerical Recipes, 2007, section
/// 9.4). The result is accurate to a few roundings of the coordinates. A sign change without a zero, at a pole or a
/// jump, is told by |f| getting neither smaller than at both ends nor negligible: not converged.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> intersect_segment(const Traits& traits, const typename Traits::Point_3& a,
                                                     const typename Traits::Point_3& b, const typename Traits::FT& fa,
                                                     const typename Traits::FT& fb) {
  using FT = typename Traits::FT;
  using std::abs;
  constexpr int maximal_iterations = 200; // bisection alone needs 60 in double
  const auto direction = b - a;
  const FT length = std::max({abs(direction.x()), abs(direction.y()), abs(direction.z())});
  const FT magnitude = std::max({abs(a.x()), abs(a.y()), abs(a.z()), length});
  const FT tolerance = FT(2) * std::numeric_limits<FT>::epsilon() * magnitude / length;
  const FT smaller_end = std::min(abs(fa), abs(fb)), larger_end = std::max(abs(fa), abs(fb));
  const FT negligible = FT(1e-6) * (larger_end - larger_end == FT(0) ? larger_end : smaller_end);
  const bool starts_negative = fa < FT(0);

  FT lower(0), upper(1), last_step(1), t = fa / (fa - fb);
  if (!(t >= FT(0) && t <= FT(1))) t = FT(0.5); // infinite ends
  const auto result = [&](bool has_converged, int n) {
    return Surface_point_3<Kernel_of<Traits>>{a + t * direction, has_converged, std::size_t(n)};
  };
  for (int n = 1; n <= maximal_iterations; ++n) {
    const auto jet = first_order(traits, a + t * direction);
    const auto& c = jet.coefficients();
    const FT slope = c[1] * direction.x() + c[2] * direction.y() + c[3] * direction.z();
    if (c[0] == FT(0)) return result(true, n);
    if (!(c[0] < FT(0) || c[0] > FT(0))) return result(false, n); // NaN
    const bool is_plausible = abs(c[0]) < smaller_end || abs(c[0]) <= negligible;
    FT step = -c[0] / slope;
    if (abs(step) <= tolerance) {
      t = std::clamp(t + step, FT(0), FT(1));
      return result(is_plausible, n);
    }
    ((c[0] < FT(0)) == starts_negative ? lower : upper) = t;
    if (!(t + step > lower && t + step < upper) || abs(step) > abs(last_step) / FT(2))
      step = (lower + upper) / FT(2) - t;
    last_step = step;
    t += step;
    if (abs(step) <= tolerance) return result(is_plausible, n);
  }
  return result(false, maximal_iterations);
}

/// The zero of f nearest to p along the line through p in the direction of the gradient, at most `maximal_distance`
/// away.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> project_to_surface(const Traits& traits, const typename Traits::Point_3& p,
                                                      const typename Traits::FT& maximal_distance) {
  using FT = typename Traits::FT;
  using std::abs;
  using std::sqrt;
  const auto jet = first_order(traits, p);
  const auto& c = jet.coefficients();
  const FT magnitude = std::max({abs(p.x()), abs(p.y()), abs(p.z()), maximal_distance});
  const FT rounding = FT(4) * std::numeric_limits<FT>::epsilon() * magnitude;
  const FT distance = distance_estimate(jet);
  if (distance <= rounding) return {p, true, 1}; // no point of the line is nearer, and signs there are noise
  const typename Traits::Vector_3 gradient(c[1], c[2], c[3]);
  const FT norm = sqrt(gradient.squared_length());
  std::size_t evaluations = 1;
  if (norm > FT(0) && c[0] - c[0] == FT(0)) {
    const auto unit = gradient * ((c[0] > FT(0) ? FT(-1) : FT(1)) / norm); // towards the surface
    FT reach = FT(2) * distance;
    for (bool is_last = false; !is_last; reach = FT(2) * reach) {
      is_last = !(reach < maximal_distance);
      const auto end = p + std::min(reach, maximal_distance) * unit;
      const FT value = traits.value(end);
      ++evaluations;
      if (!(value == value)) break;
      if ((value < FT(0)) == (c[0] < FT(0))) continue;
      auto result = intersect_segment(traits, p, end, c[0], value);
      result.evaluations += evaluations;
      return result;
    }
  }
  return {p, false, evaluations};
}

} // namespace equiaffine

#endif
