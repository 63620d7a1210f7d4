// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_MAP_DISTANCES_H
#define EQUIAFFINE_SRC_REGISTRATION_MAP_DISTANCES_H

#include "registration/Affine_map_3.h"
#include "registration/Framed_surface_3.h"
#include <equiaffine/base/internal/parallel_for.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// A point of one surface in the space of the target, with its distance from the other surface there.
struct Mapped_point {
  Eigen::Vector3d point;
  Signed_distance_3 to_other; ///< the distance is NaN outside of the other's domain
};

/// Probes of the source moved by a map, with their distances from the target.
inline std::vector<Mapped_point> moved_source(bool in_threads, const Framed_surface_3& source,
                                              const Framed_surface_3& target, const Affine_map_3& map,
                                              std::size_t count) {
  std::vector<Mapped_point> result(std::min(count, source.probes.size()));
  parallel_for(
      in_threads, 0, result.size(),
      [&](std::size_t i) {
        const Eigen::Vector3d p = map(source.probes[i]);
        result[i] = {p, target.refinement.distance(p)};
      },
      32);
  return result;
}

/// Probes of the target with their distances from the moved source.
inline std::vector<Mapped_point> target_beside_moved_source(bool in_threads, const Framed_surface_3& source,
                                                            const Framed_surface_3& target, const Affine_map_3& map,
                                                            std::size_t count) {
  const Affine_map_3 inverse = map.inverse();
  std::vector<Mapped_point> result(std::min(count, target.probes.size()));
  parallel_for(
      in_threads, 0, result.size(),
      [&](std::size_t i) {
        const auto [distance, normal] = source.refinement.distance(inverse(target.probes[i]));
        const Eigen::Vector3d conormal = inverse.matrix.transpose() * normal;
        const double length = conormal.norm();
        result[i] = {target.probes[i], {distance / length, conormal / length}};
      },
      32);
  return result;
}

/// The unit of distances that belong to a map: the size of the target, or that of the moved source if it is smaller, so
/// that no map gets better by making the source small.
inline double unit_of_distances(const Framed_surface_3& source, const Framed_surface_3& target,
                                const Affine_map_3& map) {
  std::vector<Eigen::Vector3d> moved;
  for (std::size_t i = 0; i < std::min<std::size_t>(100, source.probes.size()); ++i)
    moved.push_back(map(source.probes[i]));
  return std::min(target.size, size_of_points(moved));
}

} // namespace equiaffine::internal

#endif
