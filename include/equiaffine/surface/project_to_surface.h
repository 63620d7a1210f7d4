// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_PROJECT_TO_SURFACE_H
#define EQUIAFFINE_SURFACE_PROJECT_TO_SURFACE_H

#include <equiaffine/function/concepts.h>
#include <equiaffine/surface/sign_change.h>

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

namespace internal {

/// A sign change of f on the segment ab, and what a root finder may conclude from a value near it.
template <class Kernel>
struct Bracket_3 {
  using FT = typename Kernel::FT;

  Bracket_3(const typename Kernel::Point_3& first, const typename Kernel::Point_3& last, const FT& f_first,
            const FT& f_last)
      : a(first), direction(last - first), fa(f_first), fb(f_last) {
    using std::abs;
    const FT length = std::max({abs(direction.x()), abs(direction.y()), abs(direction.z())});
    const FT magnitude = std::max({abs(a.x()), abs(a.y()), abs(a.z()), length});
    tolerance = FT(2) * std::numeric_limits<FT>::epsilon() * magnitude / length;
    smaller_end = std::min(abs(fa), abs(fb));
    const FT larger_end = std::max(abs(fa), abs(fb));
    negligible = FT(1e-6) * (larger_end - larger_end == FT(0) ? larger_end : smaller_end);
  }

  /// A pole or a jump has no such value.
  bool is_plausible(const FT& value) const {
    using std::abs;
    return abs(value) < smaller_end || abs(value) <= negligible;
  }

  Surface_point_3<Kernel> point(const FT& t, bool has_converged, int evaluations) const {
    return {a + t * direction, has_converged, std::size_t(evaluations)};
  }

  static constexpr int maximal_evaluations = 200; // bisection alone needs 60 in double

  typename Kernel::Point_3 a;
  typename Kernel::Vector_3 direction;
  FT fa, fb;
  FT tolerance; // of fractions of the segment
  FT smaller_end, negligible;
};

/// Newton's method on the restriction of f, kept within the bracket by bisection whenever a step would leave it or not
/// halve the last one (Press et al., Numerical Recipes, 2007, section 9.4).
template <class Kernel, class Traits>
Surface_point_3<Kernel> newton(const Traits& traits, const Bracket_3<Kernel>& bracket) {
  using FT = typename Kernel::FT;
  using std::abs;
  const auto& direction = bracket.direction;
  FT lower(0), upper(1), last_step(1), t = linear_zero(bracket.fa, bracket.fb);
  for (int n = 1; n <= bracket.maximal_evaluations; ++n) {
    const auto jet = first_order(traits, bracket.a + t * direction);
    const auto& c = jet.coefficients();
    const FT slope = c[1] * direction.x() + c[2] * direction.y() + c[3] * direction.z();
    if (c[0] == FT(0)) return bracket.point(t, true, n);
    if (!(c[0] < FT(0) || c[0] > FT(0))) return bracket.point(t, false, n); // NaN
    FT step = -c[0] / slope;
    if (abs(step) <= bracket.tolerance)
      return bracket.point(std::clamp(t + step, FT(0), FT(1)), bracket.is_plausible(c[0]), n);
    ((c[0] < FT(0)) == (bracket.fa < FT(0)) ? lower : upper) = t;
    if (!(t + step > lower && t + step < upper) || abs(step) > abs(last_step) / FT(2))
      step = (lower + upper) / FT(2) - t;
    last_step = step;
    t += step;
    if (abs(step) <= bracket.tolerance) return bracket.point(t, bracket.is_plausible(c[0]), n);
  }
  return bracket.point(t, false, bracket.maximal_evaluations);
}

/// Inverse quadratic interpolation where it is safe, else bisection (Chandrupatla, A new hybrid quadratic/bisection
/// algorithm for finding the zero of a nonlinear function without using derivatives, 1997).
template <class Kernel, class Traits>
Surface_point_3<Kernel> chandrupatla(const Traits& traits, const Bracket_3<Kernel>& bracket) {
  using FT = typename Kernel::FT;
  using std::abs;
  FT x1(0), f1 = bracket.fa, x2(1), f2 = bracket.fb,
            fraction = linear_zero(bracket.fa, bracket.fb); // the zero is between x1 and x2
  for (int n = 1; n <= bracket.maximal_evaluations; ++n) {
    const FT x = x1 + fraction * (x2 - x1);
    const FT f = traits.value(bracket.a + x * bracket.direction);
    if (f == FT(0)) return bracket.point(x, true, n);
    if (!(f < FT(0) || f > FT(0))) return bracket.point(x, false, n); // NaN
    FT x3 = x1, f3 = f1;
    if ((f < FT(0)) != (f1 < FT(0))) {
      x3 = x2, f3 = f2;
      x2 = x1, f2 = f1;
    }
    x1 = x, f1 = f;
    const FT smallest_step = bracket.tolerance / abs(x2 - x1);
    if (!(smallest_step < FT(0.5))) {
      const bool is_first_better = abs(f1) < abs(f2);
      return bracket.point(is_first_better ? x1 : x2, bracket.is_plausible(is_first_better ? f1 : f2), n);
    }
    const FT xi = (x1 - x2) / (x3 - x2), phi = (f1 - f2) / (f3 - f2);
    const bool is_safe = phi * phi < xi && (FT(1) - phi) * (FT(1) - phi) < FT(1) - xi;
    fraction = is_safe ? f1 / (f2 - f1) * (f3 / (f2 - f3)) + (x3 - x1) / (x2 - x1) * (f1 / (f3 - f1)) * (f2 / (f3 - f2))
                       : FT(0.5);
    fraction = std::clamp(fraction, smallest_step, FT(1) - smallest_step);
  }
  return bracket.point(x1, false, bracket.maximal_evaluations);
}

} // namespace internal

/// A zero of f on the segment ab, at whose ends f has the values fa and fb of different signs (0 counts as positive):
/// by Newton's method where the model has derivatives that cost less than `taylor`, else by Chandrupatla's, both from
/// the linear interpolation and kept within the bracket. The result is accurate to a few roundings of the coordinates.
/// A sign change without a zero, at a pole or a jump, is told by |f| getting neither smaller than at both ends nor
/// negligible: not converged. A model with a member of this name is asked instead.
template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> intersect_segment(const Traits& traits, const typename Traits::Point_3& a,
                                                     const typename Traits::Point_3& b, const typename Traits::FT& fa,
                                                     const typename Traits::FT& fb) {
  if constexpr (requires { traits.intersect_segment(a, b, fa, fb); }) {
    return traits.intersect_segment(a, b, fa, fb);
  } else {
    const internal::Bracket_3<Kernel_of<Traits>> bracket(a, b, fa, fb);
    if constexpr (FirstOrderImplicitFunctionTraits_3<Traits>) return internal::newton(traits, bracket);
    else return internal::chandrupatla(traits, bracket);
  }
}

/// The zero of f nearest to p along the line through p in the direction of the gradient, at most `maximal_distance`
/// away. `jet` is the expansion of f at p; evaluations are counted from there.
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
  if (distance <= rounding) return {p, true, 0}; // no point of the line is nearer, and signs there are noise
  const typename Traits::Vector_3 gradient(c[1], c[2], c[3]);
  const FT norm = sqrt(gradient.squared_length());
  std::size_t evaluations = 0;
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

template <ImplicitFunctionTraits_3 Traits>
Surface_point_3<Kernel_of<Traits>> project_to_surface(const Traits& traits, const typename Traits::Point_3& p,
                                                      const typename Traits::FT& maximal_distance) {
  auto result = project_to_surface(traits, p, maximal_distance, first_order(traits, p));
  ++result.evaluations;
  return result;
}

} // namespace equiaffine

#endif
