// SPDX-License-Identifier: GPL-3.0-or-later
// Evidence against a map that has moved one of two meshes to the other.
#ifndef EQUIAFFINE_REGISTRATION_CONTRADICTIONS_OF_MESHES_H
#define EQUIAFFINE_REGISTRATION_CONTRADICTIONS_OF_MESHES_H

#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <array>
#include <ranges>

namespace equiaffine {

/// The evidence of two meshes against the map that aligned them.
struct Mesh_contradictions {
  /// The fraction of the points of each mesh that lie on the other one.
  std::array<double, 2> inliers = {0, 0};
  /// The points of each mesh off the other one although it does not end there, as a fraction of these and of those
  /// on it.
  std::array<double, 2> parts = {0, 0};
  double rms = 0; ///< root mean square distance of the points that lie on the other mesh
  /// Whether both meshes have exact symmetries, so that they are solids with these corners rather than samples of a
  /// smooth surface.
  bool are_exact_solids = false;
  bool are_closed = false; ///< whether neither mesh has a border
};

} // namespace equiaffine

// Defined in the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Returns the contradictions for the orientation of the source with more points in contact. Meshes without an area
/// have no contradictions.
Mesh_contradictions contradictions_of_triangles(Triangles_3 source, Triangles_3 target, double distance);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

namespace equiaffine {

/// Returns the evidence against a map that has moved one of two polygon soups to the other: points of either mesh
/// that lie off the other one although it does not end there. Points lie on the other mesh if they are within
/// `distance`, or within the distance of facets from a smooth surface. Either mesh may be inside out.
///
/// Takes 16,000 nearest-point queries.
/// \throw std::invalid_argument if a coordinate is not finite, or an index of a polygon is out of range.
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
