// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_DISTANCE_TO_SURFACE_H
#define EQUIAFFINE_SURFACE_DISTANCE_TO_SURFACE_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/surface/internal/newton_distance.h>

#include <CGAL/tags.h>

#include <span>

namespace equiaffine {

/// The greatest |f| / |grad f| over the points: to first order their distance from the zero set of f. Points where f is
/// undefined do not count, nor do those whose `status`, if it is given, is UNCONVERGED; the result is NaN if no point
/// counts, or if Newton's method does not lead from one of them to a zero, as beside a pole. Takes one evaluation with
/// gradient per point, and one without. CGAL::Sequential_tag and CGAL::Parallel_tag give the same result.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits>
typename Traits::FT max_distance_to_surface(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                            std::span<const Point_status> status = {}) {
  check_argument(status.empty() || status.size() == points.size(),
                 "there are not as many statuses as points: give one for each point, or none");
  return internal::max_newton_distance<ConcurrencyTag>(traits, points, status);
}

} // namespace equiaffine

#endif
