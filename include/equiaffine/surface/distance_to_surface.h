// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_DISTANCE_TO_SURFACE_H
#define EQUIAFFINE_SURFACE_DISTANCE_TO_SURFACE_H

#include <equiaffine/base/check_argument.h>
#include <equiaffine/base/parallel_for.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/surface/distance_estimate.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace equiaffine {

/// The greatest |f| / |grad f| over the points: to first order their distance from the zero set of f. Points where f is
/// undefined do not count, nor do those whose `status`, if it is given, is UNCONVERGED; the result is NaN if no point
/// counts. Takes one evaluation with gradient per point. CGAL::Sequential_tag and CGAL::Parallel_tag give the same result.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits>
typename Traits::FT max_distance_to_surface(const Traits& traits, std::span<const typename Traits::Point_3> points,
                                            std::span<const Point_status> status = {}) {
  using FT = typename Traits::FT;
  check_argument(status.empty() || status.size() == points.size(),
                 "there are not as many statuses as points: give one for each point, or none");
  std::vector<FT> distances(points.size());
  parallel_for<ConcurrencyTag>(
      0, points.size(), [&](std::size_t i) { distances[i] = distance_estimate(first_order(traits, points[i])); }, 256);
  FT greatest = std::numeric_limits<FT>::quiet_NaN();
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (!status.empty() && status[i] == Point_status::UNCONVERGED) continue;
    if (!(distances[i] <= greatest) && distances[i] == distances[i]) greatest = distances[i];
  }
  return greatest;
}

} // namespace equiaffine

#endif
