// SPDX-License-Identifier: GPL-3.0-or-later
// The maximum distance of points to the zero set of a function, to first order.
#ifndef EQUIAFFINE_SURFACE_DISTANCE_TO_SURFACE_H
#define EQUIAFFINE_SURFACE_DISTANCE_TO_SURFACE_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/function/Surface_point_3.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/function/internal/point_blocks.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/surface/internal/jet_derivatives.h>
#include <equiaffine/surface/project_to_surface.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <numbers>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// A step of Newton's method from a point toward a zero of f.
template <class Kernel>
struct Newton_step_3 {
  using FT = typename Kernel::FT;
  using Vector_3 = typename Kernel::Vector_3;

  /// The distance is the length of Newton's step. If it is shorter than `resolvable`, rounding determines the value
  /// at its end, and a much longer step is taken.
  Newton_step_3(const typename Kernel::Point_3& p, const Jet_3<FT, 1>& jet, const FT& resolvable)
      : distance(distance_estimate(jet)), value(jet.value()), is_short(distance < resolvable), end(p) {
    using std::abs;
    using std::sqrt;
    constexpr double longer = 16;
    if (!(distance > FT(0))) return;
    const auto& c = jet.coefficients();
    const FT length = is_short ? FT(longer) * resolvable : distance;
    const Vector_3 slope = gradient_of<Vector_3>(jet) / std::max({abs(c[1]), abs(c[2]), abs(c[3])}); // cannot overflow
    end = p + (value > FT(0) ? -length : length) / sqrt(slope.squared_length()) * slope;
  }

  /// Whether the value at the end of the step shows that it does not lead to a zero. Toward a zero of order m, f
  /// changes its sign or shrinks by the factor (1 - 1/m)^m, which is less than 1/e. Away from a pole of order n it
  /// keeps its sign and shrinks by (1 + 1/n)^-n, which is more. A longer step that passes a zero ends at a larger
  /// |f|; away from a pole it ends at a smaller one. Returns false if f is undefined at the end.
  bool leads_away_from_zeros(const FT& value_at_end) const {
    using std::abs;
    if (!(distance > FT(0)) || is_sign_change(value, value_at_end)) return false;
    const FT here = abs(value), there = abs(value_at_end);
    return is_short ? there < here : there > here / FT(std::numbers::e);
  }

  FT distance, value;
  bool is_short;
  typename Kernel::Point_3 end;
};

/// The maximum distance of a set of points; NaN if Newton's method leads away from zeros at one of them, or if the
/// set is empty. Undefined distances are ignored.
template <class FT>
struct Greatest_distance {
  void add(const FT& distance) {
    if (!(distance <= greatest) && distance == distance) greatest = distance;
  }

  FT result() const { return is_unknown ? std::numeric_limits<FT>::quiet_NaN() : greatest; }

  FT greatest = std::numeric_limits<FT>::quiet_NaN();
  bool is_unknown = false;
};

/// Returns the maximum distance of points that are evaluated together.
template <class Traits>
Greatest_distance<typename Traits::FT> greatest_distance_of_block(const Batch_function_traits_3<Traits>& traits,
                                                                  std::span<const typename Traits::Point_3> points,
                                                                  const typename Traits::FT& resolvable) {
  using FT = typename Traits::FT;
  std::vector<Jet_3<FT, 1>> jets(points.size());
  traits.first_orders(points, jets);
  std::vector<Newton_step_3<Kernel_of<Traits>>> steps;
  std::vector<typename Traits::Point_3> ends;
  for (std::size_t i = 0; i < points.size(); ++i) {
    steps.emplace_back(points[i], jets[i], resolvable);
    ends.push_back(steps[i].end);
  }
  std::vector<FT> values(points.size());
  traits.values(ends, values);
  Greatest_distance<FT> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    result.add(steps[i].distance);
    result.is_unknown |= steps[i].leads_away_from_zeros(values[i]);
  }
  return result;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// The maximum of |f| / |grad f| over the points, which is to first order their maximum distance from the zero set of
/// f. Points at which f is undefined are ignored, and points whose `status`, if given, is UNCONVERGED. The result is
/// NaN if no point is left, or if Newton's method does not lead from one of them to a zero, for example near a pole.
/// Takes one evaluation with gradient and one without per point. CGAL::Sequential_tag and CGAL::Parallel_tag give the
/// same result.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits>
typename Traits::FT max_distance_to_surface(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                            std::span<const Point_status> status = {}) {
  check_argument(status.empty() || status.size() == points.size(),
                 "the number of statuses differs from the number of points: give one for each point, or none");
  using FT = typename Traits::FT;
  using std::abs;
  using std::sqrt;
  using Batch = Batch_function_traits_3<Traits>;
  constexpr std::size_t block = 256;
  FT coordinate(0);
  for (const auto& p : points) coordinate = std::max({coordinate, abs(p.x()), abs(p.y()), abs(p.z())});
  const FT resolvable = sqrt(std::numeric_limits<FT>::epsilon()) * coordinate;
  internal::Greatest_distance<FT> result;
  std::mutex mutex;
  // The margin of 1 is needed because the end of a step may be in the next cell.
  for_each_point_block<ConcurrencyTag>(
      Batch(traits), points, block, 1, [&](const Batch& local, std::span<const std::size_t> numbers) {
        std::vector<typename Traits::Point_3> points_of_block;
        for (const std::size_t n : numbers)
          if (status.empty() || status[n] != Point_status::UNCONVERGED) points_of_block.push_back(points[n]);
        const auto of_block = internal::greatest_distance_of_block<Traits>(local, points_of_block, resolvable);
        const std::lock_guard lock(mutex);
        result.add(of_block.greatest);
        result.is_unknown |= of_block.is_unknown;
      });
  return result.result();
}

} // namespace equiaffine

#endif
