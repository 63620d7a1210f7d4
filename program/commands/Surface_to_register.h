// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces among whose points maps are sought, and the meshes by which pages, pictures and files show these maps.
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_SURFACE_TO_REGISTER_H
#define EQUIAFFINE_PROGRAM_COMMANDS_SURFACE_TO_REGISTER_H

#include "request/options.h"
#include "system/kernel.h"
#include "system/progress.h"
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/registration/affine_symmetries.h>
#include <equiaffine/registration/register_surfaces.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace equiaffine {

/// A level set with points on it.
struct Surface_to_register {
  Any_function_3 function;                        ///< whose zero set is the level set
  std::optional<Any_function_3> unsmoothed = {};  ///< if the function is a spline through smoothed samples
  Indexed_triangle_mesh_3<Kernel> mesh = {};      ///< the data of a fit, else what Marching Cubes makes
  Indexed_triangle_mesh_3<Kernel> extracted = {}; ///< what Marching Cubes makes of a fit to points without faces
  std::optional<double> scale = {};               ///< of the curvatures of a fit, unless they are the surface's own

  const Any_function_3& refined() const { return unsmoothed ? *unsmoothed : function; }
  const Indexed_triangle_mesh_3<Kernel>& shown() const { return mesh.triangles.empty() ? extracted : mesh; }
};

/// Whether the triangles of a file are the surface, and no level set of a function.
bool is_mesh_itself(const Surface_options& options);

/// Makes the source and its surface. `is_shown` says whether faces are needed. Throws `Input_error`, also if there is no
/// surface.
Surface_to_register make_surface_to_register(const Surface_options& options, bool is_shown, Progress& progress);

/// The diagonal of the box around points.
double diagonal_of(const std::vector<Kernel::Point_3>& points);

/// The distances of points from a surface; NaN where they are not known.
using Distances_of_points = std::function<std::vector<double>(const std::vector<Kernel::Point_3>&)>;

/// Returns the distances to first order from the image of a level set, which has to outlive the result, under the inverse
/// of `back`, or those from the triangles of a mesh.
Distances_of_points distances_from(const Any_function_3& surface,
                                   const CGAL::Aff_transformation_3<Kernel>& back = CGAL::IDENTITY);
Distances_of_points distances_from(const Indexed_triangle_mesh_3<Kernel>& mesh);

/// The mesh moved by a map, with normals on the same side.
Indexed_triangle_mesh_3<Kernel> moved(Indexed_triangle_mesh_3<Kernel> mesh,
                                      const CGAL::Aff_transformation_3<Kernel>& map);

/// The source moved by a map, with the column `distance`: how far vertices are from the target, or NaN where that is not
/// known.
Annotated_mesh_3<Kernel> moved_source(const Surface_to_register& source, const Distances_of_points& from_target,
                                      const CGAL::Aff_transformation_3<Kernel>& map);

/// The target, the source moved by the best map over it, or as it is if there is none, and the frames of the pair of
/// points that gave the map, as arrows. The columns are `distance` from the other surface, the moved source or the
/// target, and `surface`: 0 for the target, 1 for the source, 2 and 3 for the frames of the target and of the source.
Annotated_mesh_3<Kernel> registered_surfaces(const Surface_to_register& source, const Surface_to_register& target,
                                             const std::array<Distances_of_points, 2>& from_source_and_target,
                                             const Surface_registration_3<Kernel>& registration);

/// The surface with the column `distance`, the greatest distance of images of a vertex under the symmetries, `surface`, 0
/// for the surface and the next numbers for planes of reflection and axes of rotation, if there are any, and columns
/// generatorN_x, generatorN_y, generatorN_z, the velocity of the vertex by each continuous one.
Annotated_mesh_3<Kernel> surface_with_symmetries(const Indexed_triangle_mesh_3<Kernel>& surface,
                                                 const Affine_symmetries_3<Kernel>& symmetries,
                                                 const Distances_of_points& distances);

} // namespace equiaffine

#endif
