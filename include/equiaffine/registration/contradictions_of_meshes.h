// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_CONTRADICTIONS_OF_MESHES_H
#define EQUIAFFINE_REGISTRATION_CONTRADICTIONS_OF_MESHES_H

#include <equiaffine/mesh/internal/triangles_of.h>
#include <equiaffine/registration/Mesh_contradictions.h>
#include <equiaffine/registration/internal/searches.h>

#include <ranges>

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
