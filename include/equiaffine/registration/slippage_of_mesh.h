// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_SLIPPAGE_OF_MESH_H
#define EQUIAFFINE_REGISTRATION_SLIPPAGE_OF_MESH_H

#include <equiaffine/mesh/internal/triangles_of.h>
#include <equiaffine/registration/Affine_slippage_3.h>
#include <equiaffine/registration/Map_kind.h>
#include <equiaffine/registration/internal/searches.h>

#include <ranges>

namespace equiaffine {

/// Returns how a mesh, points with polygons between them, slides over itself by maps of a kind. The maps are those whose
/// velocity is about tangent to the facets (N. Gelfand, L. Guibas, Shape segmentation using local slippage analysis,
/// 2004), and by which motions of a third of the size, or a sixth on narrow pieces, move no point further off the mesh
/// than its facets are off a smooth surface. What moves across the border of the mesh tells nothing. The facets of a
/// solid with corners are its faces, so that a prism does not turn, however many sides it has.
///
/// Takes the nearest points of a tree for 4000 points and at most 20 motions of each of at most 12 maps.
/// \throw std::invalid_argument if a coordinate is not finite, or a polygon has the position of no point.
template <std::ranges::input_range Points, std::ranges::input_range Polygons>
Affine_slippage_3 slippage_of_mesh(const Points& points, const Polygons& polygons, Map_kind kind) {
  return internal::slippage_of_triangles(false, internal::triangles_of_soup(points, polygons), kind);
}

} // namespace equiaffine

#endif
