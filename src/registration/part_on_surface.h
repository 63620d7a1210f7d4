// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_PART_ON_SURFACE_H
#define EQUIAFFINE_SRC_REGISTRATION_PART_ON_SURFACE_H

#include "registration/map_distances.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// The part of the points in the domain of the other surface that lie on it to within a distance; 0 if most points are
/// outside of the domain.
inline double part_on_surface(const std::vector<Mapped_point>& points, double distance) {
  std::size_t inside = 0, on_surface = 0;
  for (const Mapped_point& p : points) {
    inside += !std::isnan(p.to_other.distance);
    on_surface += std::abs(p.to_other.distance) < distance;
  }
  return 2 * inside > points.size() ? double(on_surface) / double(inside) : 0;
}

/// So much of a surface, at least, has to lie on another one that is the same. The rest may be points that are not on
/// the zero set, or where the function is not smooth.
constexpr double part_of_same_surface = 0.98;

} // namespace equiaffine::internal

#endif
