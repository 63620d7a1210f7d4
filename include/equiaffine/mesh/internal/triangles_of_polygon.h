// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_TRIANGLES_OF_POLYGON_H
#define EQUIAFFINE_MESH_INTERNAL_TRIANGLES_OF_POLYGON_H

#include <equiaffine/mesh/internal/Planar_polygon.h>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine {

/// Appends the triangles of a polygon, whose corners are positions of points: the fan around its first corner if no
/// triangle of it is turned over, as in convex polygons, else ears that are cut off one after the other (G. H. Meisters,
/// Polygons have ears, 1975). Polygons that cross themselves, and those of more than 1000 corners, are cut into the fan.
///
/// Takes linear time for a fan, and at most cubic time for ears.
/// \pre the positions are those of points.
template <class Points>
void add_triangles_of_polygon(const Points& points, const std::vector<std::uint32_t>& polygon,
                              std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (polygon.size() < 4) {
    if (polygon.size() == 3) triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  std::vector<Eigen::Vector3d> corners;
  for (const std::uint32_t i : polygon) corners.emplace_back(points[i].x(), points[i].y(), points[i].z());
  for (const auto& [a, b, c] : internal::Planar_polygon(corners).triangles())
    triangles.push_back({polygon[a], polygon[b], polygon[c]});
}

} // namespace equiaffine

#endif
