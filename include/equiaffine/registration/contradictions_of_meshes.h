// SPDX-License-Identifier: GPL-3.0-or-later
// What speaks against a map that has moved one of two meshes to the other.
#ifndef EQUIAFFINE_REGISTRATION_CONTRADICTIONS_OF_MESHES_H
#define EQUIAFFINE_REGISTRATION_CONTRADICTIONS_OF_MESHES_H

#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <array>
#include <ranges>

namespace equiaffine {

/// The evidence of two meshes against the map that has brought them together.
struct Mesh_contradictions {
  /// The points of each mesh that lie on the other one, as a part of all.
  std::array<double, 2> inliers = {0, 0};
  /// The points of each mesh that lie off the other one although it does not end there, as a part of these and of those
  /// that lie on it.
  std::array<double, 2> parts = {0, 0};
  double rms = 0; ///< the root of the mean squared distance of the points that lie on the other mesh
  /// Whether both meshes have symmetries that are exact, so that they are solids with these corners, and no samples of
  /// a smooth surface.
  bool are_exact_solids = false;
  bool are_closed = false; ///< whether neither mesh has a border, so that both end nowhere
};

} // namespace equiaffine

// The library defines this function.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Returns the contradictions with the side of the source by which more points are in contact. Meshes without an area
/// have none.
Mesh_contradictions contradictions_of_triangles(Triangles_3 source, Triangles_3 target, double distance);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

namespace equiaffine {

/// Returns what speaks against a map that has moved one of two meshes, points with polygons between them, to the other:
/// points of either mesh that lie off the other one although it does not end there. Points within `distance`, or within
/// what facets are off a smooth surface, lie on it. Either mesh may be inside out.
///
/// Takes 16,000 nearest points of a tree.
/// \throw std::invalid_argument if a coordinate is not finite, or a polygon has the position of no point.
template <std::ranges::input_range Points, std::ranges::input_range Polygons, std::ranges::input_range Target_points,
          std::ranges::input_range Target_polygons>
Mesh_contradictions contradictions_of_meshes(const Points& points, const Polygons& polygons,
                                             const Target_points& target_points, const Target_polygons& target_polygons,
                                             double distance) {
  return internal::contradictions_of_triangles(internal::triangles_of_soup(points, polygons),
                                               internal::triangles_of_soup(target_points, target_polygons), distance);
}

} // namespace equiaffine

#endif
