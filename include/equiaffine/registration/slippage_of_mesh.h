// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the infinitesimal maps along which a mesh slides over itself.
#ifndef EQUIAFFINE_REGISTRATION_SLIPPAGE_OF_MESH_H
#define EQUIAFFINE_REGISTRATION_SLIPPAGE_OF_MESH_H

#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/registration/Registration_options.h>

#include <Eigen/Core>

#include <cstddef>
#include <ranges>
#include <vector>

namespace equiaffine {

/// A velocity field p' = matrix p + translation that is tangent to a surface everywhere.
struct Infinitesimal_map_3 {
  Eigen::Matrix3d matrix;      ///< linear part
  Eigen::Vector3d translation; ///< constant part
};

/// The infinitesimal maps along which a surface slides over itself: the Lie algebra of the continuous group of its
/// symmetries. For a mesh, to within a distance, those of the smooth surface that its facets approximate.
struct Affine_slippage_3 {
  std::vector<Infinitesimal_map_3> generators; ///< a basis
  /// How far the surface slides off itself, relative to its size: the rms distance of its points after motions of
  /// finite length. If frames of a function give the result, the rms of the normal part of the velocity relative to
  /// the largest velocity. 0 if only rounding is left.
  double rms = 0;

  std::size_t dimension() const { return generators.size(); } ///< dimension of the group; 0 if the surface does not
                                                              ///< slide
};

} // namespace equiaffine

// Defined in the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Returns how the surface approximated by the triangles of a mesh slides over itself.
Affine_slippage_3 slippage_of_triangles(bool in_threads, const Triangles_3& mesh, Map_kind kind);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

namespace equiaffine {

/// Returns how a mesh, given as a polygon soup, slides over itself by maps of a kind. The velocities of these maps
/// are nearly tangent to the facets (N. Gelfand, L. Guibas, Shape segmentation using local slippage analysis, 2004).
/// Motions of a third of the size, or a sixth on narrow pieces, move no point farther off the mesh than its facets
/// are off a smooth surface. Points that move across the border of the mesh are ignored. The facets of a solid with
/// corners are its faces, so a prism does not turn, regardless of its number of sides.
///
/// Takes nearest-point queries for 4000 points and at most 20 motions of each of at most 12 maps.
/// \throw std::invalid_argument if a coordinate is not finite, or an index of a polygon is out of range.
template <std::ranges::input_range Points, std::ranges::input_range Polygons>
Affine_slippage_3 slippage_of_mesh(const Points& points, const Polygons& polygons, Map_kind kind) {
  return internal::slippage_of_triangles(false, internal::triangles_of_soup(points, polygons), kind);
}

} // namespace equiaffine

#endif
