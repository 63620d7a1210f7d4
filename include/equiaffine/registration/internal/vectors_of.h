// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_VECTORS_OF_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_VECTORS_OF_H

#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <Eigen/Core>

#include <vector>

namespace equiaffine::internal {

/// The coordinates of a range of CGAL's points, as doubles.
template <class Points>
std::vector<Eigen::Vector3d> vectors_of(const Points& points) {
  std::vector<Eigen::Vector3d> result;
  for (const auto& p : points) result.push_back(coordinates_of(p));
  return result;
}

} // namespace equiaffine::internal

#endif
