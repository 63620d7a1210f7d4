// SPDX-License-Identifier: GPL-3.0-or-later
// Zeros of a function on segments: sign changes, and the search for a zero between the ends of a segment.
#ifndef EQUIAFFINE_FUNCTION_SURFACE_POINT_3_H
#define EQUIAFFINE_FUNCTION_SURFACE_POINT_3_H

#include <equiaffine/function/concepts.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace equiaffine {

/// The result of a search for a point on the zero set of f.
template <class Kernel>
struct Surface_point_3 {
  typename Kernel::Point_3 point; ///< the zero
  bool has_converged;             ///< if false, no zero was found and `point` is the best guess
  std::size_t evaluations;        ///< the number of evaluations of f with its gradient
  bool is_at_pole = false;        ///< no zero was found: f changes sign at a pole or jump, at `point`
  bool is_at_end = false;         ///< no zero was found: f or its derivatives become undefined at `point`
};

/// \cond for internal use
/// Whether the values at the ends of a segment have different signs. Zero counts as positive. False if a value is NaN.
template <class FT>
bool is_sign_change(const FT& first, const FT& second) {
  return (first < FT(0) && second >= FT(0)) || (first >= FT(0) && second < FT(0));
}

/// The zero of the linear interpolant of the values at the ends of a segment, as a fraction of the segment; 1/2 if a
/// value is infinite. \pre `is_sign_change(first, second)`
template <class FT>
FT linear_zero(const FT& first, const FT& second) {
  const FT t = first / (first - second);
  return t >= FT(0) && t <= FT(1) ? t : FT(0.5);
}
/// \endcond

} // namespace equiaffine

namespace equiaffine::internal {

/// A sign change of f on the segment ab, with criteria for values near a zero.
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
    const FT smaller_end = std::min(abs(fa), abs(fb)), larger_end = std::max(abs(fa), abs(fb));
    smaller_than_ends = (FT(1) - FT(1e-6)) * smaller_end; // clearly smaller: near a jump values differ by rounding
    negligible = FT(1e-6) * (larger_end - larger_end == FT(0) ? larger_end : smaller_end);
  }

  /// Holds for zeros, never for poles, and rarely for jumps.
  bool is_plausible(const FT& value) const {
    using std::abs;
    return abs(value) < smaller_than_ends || is_negligible(value);
  }

  /// Holds for zeros, and for jumps only if they are tiny.
  bool is_negligible(const FT& value) const {
    using std::abs;
    return abs(value) <= negligible;
  }

  Surface_point_3<Kernel> point(const FT& t, bool has_converged, int evaluations) const {
    return {a + t * direction, has_converged, std::size_t(evaluations)};
  }

  static constexpr int maximal_evaluations = 200; // bisection alone needs 60 in double

  typename Kernel::Point_3 a;
  typename Kernel::Vector_3 direction;
  FT fa, fb;
  FT tolerance; // as a fraction of the segment
  FT smaller_than_ends, negligible;
};

/// Whether f has a pole at p, to which a search that has not converged has narrowed a sign change. The criterion: from
/// a distance of 2.6e5 tolerances to one of 4, |f| grows by at least a tenth per factor of 256. A logarithm grows
/// faster; at a jump |f| has limits on both sides.
template <class Kernel, class Traits>
bool is_pole(const Traits& traits, const Bracket_3<Kernel>& bracket, const typename Kernel::Point_3& p) {
  using FT = typename Kernel::FT;
  using std::abs;
  const auto magnitude = [&](const FT& t) {
    const FT f = abs(traits.value(p + t * bracket.direction));
    return f == f ? f : FT(0); // f may be undefined on one side
  };
  FT nearer = std::numeric_limits<FT>::infinity(), distance = FT(4) * bracket.tolerance;
  for (int n = 0; n < 3; ++n, distance *= FT(256)) {
    const FT here = std::max(magnitude(distance), magnitude(-distance));
    if (!(nearer - nearer != FT(0) || nearer > FT(1.1) * here)) return false; // farther values may overflow, too
    nearer = here;
  }
  return true;
}

/// Whether f jumps at p, to which a search has narrowed a sign change: f has one-sided limits of different signs.
template <class Kernel, class Traits>
bool is_jump(const Traits& traits, const Bracket_3<Kernel>& bracket, const typename Kernel::Point_3& p) {
  using FT = typename Kernel::FT;
  using std::abs;
  const auto value = [&](const FT& t) { return traits.value(p + t * bracket.direction); };
  const FT near = FT(4) * bracket.tolerance, far = FT(256) * near;
  const FT left = value(-near), right = value(near);
  return is_sign_change(left, right) &&
         abs(value(-far) - left) + abs(value(far) - right) < FT(0.01) * abs(right - left);
}

/// Whether f, or its gradient if the model has cheap ones, is undefined next to the point where a search ended.
template <class Kernel, class Traits>
bool is_end_of_domain(const Traits& traits, const Bracket_3<Kernel>& bracket, const typename Kernel::Point_3& p) {
  using FT = typename Kernel::FT;
  const auto is_undefined = [&](const FT& t) {
    const auto q = p + t * bracket.direction;
    FT f;
    if constexpr (FirstOrderImplicitFunctionTraits_3<Traits>) f = traits.first_order(q).value();
    else f = traits.value(q);
    return !(f == f);
  };
  const FT distance = FT(4) * bracket.tolerance;
  return is_undefined(distance) || is_undefined(-distance);
}

/// Newton's method on the restriction of f to a segment. It bisects if a step would leave the bracket or is not less
/// than half of the last step (Press et al., Numerical Recipes, 2007, section 9.4), and where f has a value but no
/// derivatives: f may jump near such places, and only a Newton step can confirm a zero. The caller expands f at the
/// requested points, so that many searches can be expanded together.
template <class Kernel>
class Newton_search_3 {
  using FT = typename Kernel::FT;

public:
  explicit Newton_search_3(const Bracket_3<Kernel>& bracket)
      : bracket_(bracket), t_(linear_zero(bracket.fa, bracket.fb)) {}

  const Bracket_3<Kernel>& bracket() const { return bracket_; }

  /// The point at which the next expansion is needed; after the end of the search, the zero or the best guess.
  typename Kernel::Point_3 point() const { return bracket_.a + t_ * bracket_.direction; }

  bool has_ended() const { return has_ended_; }

  Surface_point_3<Kernel> result() const { return bracket_.point(t_, has_converged_, evaluations_); }

  /// Whether the zero that was found may be a jump.
  bool is_doubtful() const { return !bracket_.is_negligible(last_value_); }

  /// Continues with the expansion at point().
  template <class Traits>
  void advance(const Traits& traits, const Jet_3<FT, 1>& jet) {
    using std::abs;
    const auto& c = jet.coefficients();
    const auto& direction = bracket_.direction;
    ++evaluations_;
    const FT slope = c[1] * direction.x() + c[2] * direction.y() + c[3] * direction.z();
    const bool has_derivatives = c[0] == c[0];
    is_smooth_ = is_smooth_ && has_derivatives;
    const FT f = last_value_ = has_derivatives ? c[0] : traits.value(point());
    if (f == FT(0)) return end(t_, has_derivatives);
    if (!(f < FT(0) || f > FT(0))) return end(t_, false); // NaN
    FT step = -c[0] / slope;
    if (abs(step) <= bracket_.tolerance) return end(std::clamp(t_ + step, FT(0), FT(1)), bracket_.is_plausible(f));
    ((f < FT(0)) == (bracket_.fa < FT(0)) ? lower_ : upper_) = t_;
    if (!(t_ + step > lower_ && t_ + step < upper_) || abs(step) > abs(last_step_) / FT(2))
      step = (lower_ + upper_) / FT(2) - t_;
    last_step_ = step;
    t_ += step;
    if (abs(step) <= bracket_.tolerance) return end(t_, is_smooth_ && bracket_.is_plausible(f));
    if (evaluations_ == bracket_.maximal_evaluations) end(t_, false);
  }

private:
  void end(const FT& t, bool has_converged) {
    t_ = t;
    has_converged_ = has_converged;
    has_ended_ = true;
  }

  Bracket_3<Kernel> bracket_;
  FT t_, lower_ = FT(0), upper_ = FT(1), last_step_ = FT(1), last_value_ = FT(0);
  int evaluations_ = 0;
  bool is_smooth_ = true, has_converged_ = false, has_ended_ = false;
};

/// Searches by inverse quadratic interpolation where it is safe, otherwise by bisection (Chandrupatla, A new hybrid
/// quadratic/bisection algorithm for finding the zero of a nonlinear function without using derivatives, 1997).
/// `is_doubtful` is set to whether the zero that was found may be a jump.
template <class Kernel, class Traits>
Surface_point_3<Kernel> chandrupatla(const Traits& traits, const Bracket_3<Kernel>& bracket, bool& is_doubtful) {
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
      is_doubtful = !bracket.is_negligible(is_first_better ? f1 : f2);
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

/// Classifies a failed search: pole or jump, end of the domain, or neither. A doubtful zero at a jump is a failure,
/// too.
template <class Kernel, class Traits>
void classify_failure(const Traits& traits, const Bracket_3<Kernel>& bracket, bool is_doubtful,
                      Surface_point_3<Kernel>& result) {
  if (result.has_converged && !(is_doubtful && is_jump(traits, bracket, result.point))) return;
  result.has_converged = false;
  result.is_at_pole = is_pole(traits, bracket, result.point);
  result.is_at_end = !result.is_at_pole && is_end_of_domain(traits, bracket, result.point);
  result.is_at_pole = result.is_at_pole || (!result.is_at_end && is_jump(traits, bracket, result.point));
}

/// Finds a zero on the segment ab, with derivatives if the model has cheap ones.
template <class Kernel, class Traits>
Surface_point_3<Kernel> zero_on_segment(const Traits& traits, const typename Kernel::Point_3& a,
                                        const typename Kernel::Point_3& b, const typename Kernel::FT& fa,
                                        const typename Kernel::FT& fb) {
  const Bracket_3<Kernel> bracket(a, b, fa, fb);
  bool is_doubtful = false;
  auto result = [&] {
    if constexpr (FirstOrderImplicitFunctionTraits_3<Traits>) {
      Newton_search_3 search(bracket);
      while (!search.has_ended()) search.advance(traits, traits.first_order(search.point()));
      is_doubtful = search.is_doubtful();
      return search.result();
    } else {
      return chandrupatla(traits, bracket, is_doubtful);
    }
  }();
  classify_failure(traits, bracket, is_doubtful, result);
  return result;
}

} // namespace equiaffine::internal

#endif
