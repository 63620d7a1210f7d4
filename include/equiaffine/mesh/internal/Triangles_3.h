// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_TRIANGLES_3_H
#define EQUIAFFINE_MESH_INTERNAL_TRIANGLES_3_H

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// A triangle mesh in doubles.
struct Triangles_3 {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  const Eigen::Vector3d& corner(std::size_t t, std::size_t k) const { return points[triangles[t][k % 3]]; }
  Eigen::Vector3d double_area(std::size_t t) const {
    return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
  }
};

} // namespace equiaffine::internal

#endif
