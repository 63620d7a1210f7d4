// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_SEARCHES_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_SEARCHES_H

#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/internal/Triangles_3.h>
#include <equiaffine/registration/Affine_symmetries_3.h>
#include <equiaffine/registration/Map_kind.h>
#include <equiaffine/registration/Mesh_contradictions.h>
#include <equiaffine/registration/Surface_registration_3.h>
#include <equiaffine/registration/internal/requests.h>

#include <Eigen/Core>

#include <vector>

// The library defines these functions, which do the work of searches of maps. They run in the threads of TBB if
// `in_threads`. Their parameters name no type of Eigen, whose namespace has another name in the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

using Kernel_of_searches = Any_function_3::Kernel;

/// The zero set of a function, and points near it.
struct Surface_with_points_3 {
  Any_function_3 function;
  std::vector<Eigen::Vector3d> points;
};

/// A surface as register_surfaces() is given it, with a function with the same zero set on which maps are refined.
struct Refined_surface_3 : Surface_with_points_3 {
  Any_function_3 refined;
};

/// The result of register_surfaces(), and whether the best map moves all of each surface onto the other.
struct Registration_of_functions_3 {
  Surface_registration_3<Kernel_of_searches> result;
  bool is_equivalence = false;
};

/// Whole surfaces of exact functions whose frames give no map are tried without frames.
Registration_of_functions_3 registration_of_functions(bool in_threads, const Refined_surface_3& source,
                                                      const Refined_surface_3& target,
                                                      const Registration_request& request);

/// Meshes are tried as wholes, and then as pieces.
Surface_registration_3<Kernel_of_searches> registration_of_triangles(bool in_threads, const Triangles_3& source,
                                                                     const Triangles_3& target,
                                                                     const Registration_request& request);

/// Whether it was verified that no map of a kind moves one whole surface onto another. Such a map would keep the
/// centroid of the area, and affine ones the moments of the solid inside, so that all rotations and reflections about
/// the centroid are tried in the coordinates of the search for symmetries: each moves points of the first away from the
/// second.
bool differ_as_wholes(bool in_threads, const Any_function_3& source, const Any_function_3& target, Map_kind kind,
                      bool allows_reflections);

/// Returns how the surface that the triangles of a mesh stand for slides over itself.
Affine_slippage_3 slippage_of_triangles(bool in_threads, const Triangles_3& mesh, Map_kind kind);

/// The symmetries of the zero set of a function, by affine frames at the points, and by rotations of the whole.
Affine_symmetries_3<Kernel_of_searches> symmetries_of_function(bool in_threads, const Surface_with_points_3& surface,
                                                               const Symmetry_request& request);

/// The symmetries of a mesh, by rotations of the whole.
Affine_symmetries_3<Kernel_of_searches> symmetries_of_triangles(bool in_threads, const Triangles_3& mesh,
                                                                const Map_request& request);

/// Returns the contradictions with the side of the source by which more points are in contact. Meshes without an area
/// have none.
Mesh_contradictions contradictions_of_triangles(Triangles_3 source, Triangles_3 target, double distance);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
