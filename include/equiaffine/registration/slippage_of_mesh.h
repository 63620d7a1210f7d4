// SPDX-License-Identifier: GPL-3.0-or-later
// The infinitesimal maps along which a mesh slides over itself.
#ifndef EQUIAFFINE_REGISTRATION_SLIPPAGE_OF_MESH_H
#define EQUIAFFINE_REGISTRATION_SLIPPAGE_OF_MESH_H

#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/Registration_options.h>

#include <Eigen/Core>

#include <cstddef>
#include <ranges>
#include <vector>

namespace equiaffine {

/// A motion p' = matrix p + translation that is tangent to a surface everywhere.
struct Infinitesimal_map_3 {
  Eigen::Matrix3d matrix;      ///< the linear part
  Eigen::Vector3d translation; ///< the other part
};

/// The infinitesimal maps along which a surface slides over itself: the Lie algebra of the continuous group of its
/// symmetries. A mesh slides as the smooth surface does that its facets stand for, to within a distance.
struct Affine_slippage_3 {
  std::vector<Infinitesimal_map_3> generators; ///< a basis
  /// The surface slides off itself by this part of its size: the rms distance of its points after motions of finite
  /// length, or, where frames of a function tell, the rms of the normal part of the velocity, beside the largest one.
  /// It is 0 where only rounding is left.
  double rms = 0;

  std::size_t dimension() const { return generators.size(); } ///< of the group; 0 if the surface does not slide
};

} // namespace equiaffine

// The library defines this function.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Returns how the surface that the triangles of a mesh stand for slides over itself.
Affine_slippage_3 slippage_of_triangles(bool in_threads, const Triangles_3& mesh, Map_kind kind);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

namespace equiaffine {

/// Returns how a mesh, points with polygons between them, slides over itself by maps of a kind. The maps are those
/// whose velocity is about tangent to the facets (N. Gelfand, L. Guibas, Shape segmentation using local slippage
/// analysis, 2004), and by which motions of a third of the size, or a sixth on narrow pieces, move no point further off
/// the mesh than its facets are off a smooth surface. What moves across the border of the mesh tells nothing. The
/// facets of a solid with corners are its faces, so that a prism does not turn, however many sides it has.
///
/// Takes the nearest points of a tree for 4000 points and at most 20 motions of each of at most 12 maps.
/// \throw std::invalid_argument if a coordinate is not finite, or a polygon has the position of no point.
template <std::ranges::input_range Points, std::ranges::input_range Polygons>
Affine_slippage_3 slippage_of_mesh(const Points& points, const Polygons& polygons, Map_kind kind) {
  return internal::slippage_of_triangles(false, internal::triangles_of_soup(points, polygons), kind);
}

} // namespace equiaffine

#endif
