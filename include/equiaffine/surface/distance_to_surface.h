// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SURFACE_DISTANCE_TO_SURFACE_H
#define EQUIAFFINE_SURFACE_DISTANCE_TO_SURFACE_H

#include <equiaffine/base/parallel_for.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/surface/distance_estimate.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace equiaffine {

/// The greatest |f| / |grad f| over the points: to first order their distance from the zero set of f. Points where f is
/// undefined do not count, and the result is NaN if no point counts. Takes one evaluation with gradient per point.
/// CGAL::Sequential_tag and CGAL::Parallel_tag give the same result.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits>
typename Traits::FT max_distance_to_surface(const Traits& traits, std::span<const typename Traits::Point_3> points) {
  using FT = typename Traits::FT;
  std::vector<FT> distances(points.size());
  parallel_for<ConcurrencyTag>(
      0, points.size(), [&](std::size_t i) { distances[i] = distance_estimate(first_order(traits, points[i])); }, 256);
  FT greatest = std::numeric_limits<FT>::quiet_NaN();
  for (const FT& distance : distances)
    if (!(distance <= greatest) && distance == distance) greatest = distance;
  return greatest;
}

} // namespace equiaffine

#endif
