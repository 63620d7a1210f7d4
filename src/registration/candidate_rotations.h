// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_CANDIDATE_ROTATIONS_H
#define EQUIAFFINE_SRC_REGISTRATION_CANDIDATE_ROTATIONS_H

#include "registration/Centered_surface_3.h"
#include "registration/Distance_grid.h"
#include "registration/Rotation_search.h"

#include <Eigen/Core>

#include <algorithm>

namespace equiaffine::internal {

/// Returns rotations about the centroid near all that may move one surface to within an rms distance of another one, or
/// of itself.
inline Rotation_candidates candidate_rotations(bool in_threads, const Centered_surface_3& source,
                                               const Centered_surface_3& target, double tolerance,
                                               bool allows_reflections) {
  constexpr int most_points = 80;
  const double radius = 1.02 * std::max(source.samples.radius(), target.samples.radius());
  const auto grid = Distance_grid::of(in_threads, *target.distances, radius);
  const auto& points = source.samples.points;
  const Eigen::Vector3d extents = source.extents();
  const Rotation_search search(in_threads, grid, {points.begin(), points.begin() + most_points},
                               extents.tail<2>().norm());
  const double error = target.is_exact ? target.samples.spacing() / 2 : 0; // of the nearest sample
  Rotation_candidates candidates = search.run(tolerance + error, allows_reflections);
  candidates.complete_to -= error;
  return candidates;
}

} // namespace equiaffine::internal

#endif
