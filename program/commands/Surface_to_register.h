// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces to register, and the meshes that show the maps in pages, pictures and files.
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_SURFACE_TO_REGISTER_H
#define EQUIAFFINE_PROGRAM_COMMANDS_SURFACE_TO_REGISTER_H

#include "request/Request.h"
#include "system/kernel.h"
#include "system/progress.h"
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/registration/affine_symmetries.h>
#include <equiaffine/registration/internal/Surface_to_register.h>
#include <equiaffine/registration/register_surfaces.h>

#include <array>
#include <functional>
#include <vector>

namespace equiaffine {

/// Whether the surface is the triangles of a file, not a level set.
bool is_mesh_itself(const Source_options& source);

/// The origin of the derivatives of a source.
internal::Surface_origin origin_of_source(const Source_options& source);

/// Reads the data of a fit from its file, if it has one, so that they can be fitted several times. Throws
/// `Input_error`.
void read_data_once(Source_options& source, Progress& progress);

/// Makes the source and its surface. If `is_shown`, the surface has faces. Throws `Input_error`, also if there is no
/// surface.
internal::Surface_to_register make_surface_to_register(const Source_options& options, bool is_shown,
                                                       Progress& progress);

/// The same for two surfaces: a fit whose scale is chosen from the data can be repeated at other scales.
internal::Surface_to_register make_surface_of_any_scale(Source_options options, bool is_shown, Progress& progress);

/// The distances of points from a surface; NaN where unknown.
using Distances_of_points = std::function<std::vector<double>(const std::vector<Kernel::Point_3>&)>;

/// Returns distances to first order from the image of a level set under the inverse of `back`, or distances from the
/// triangles of a mesh. The level set must outlive the result.
Distances_of_points distances_from(const Any_function_3& surface,
                                   const CGAL::Aff_transformation_3<Kernel>& back = CGAL::IDENTITY);
Distances_of_points distances_from(const Indexed_triangle_mesh_3<Kernel>& mesh);

/// The source moved by a map, with the column `distance` from the target, which is NaN where unknown.
Annotated_mesh_3<Kernel> moved_source(const internal::Surface_to_register& source,
                                      const Distances_of_points& from_target,
                                      const CGAL::Aff_transformation_3<Kernel>& map);

/// The target, the source moved by the best map (unmoved if there is none), and the frames of the pair of points that
/// gave the map, as arrows. The columns are `distance` from the other surface, and `surface`: 0 for the target, 1 for
/// the source, 2 and 3 for the frames of the target and of the source.
Annotated_mesh_3<Kernel> registered_surfaces(const internal::Surface_to_register& source,
                                             const internal::Surface_to_register& target,
                                             const std::array<Distances_of_points, 2>& from_source_and_target,
                                             const Surface_registration_3<Kernel>& registration);

/// The surface with its symmetries. Columns: `distance`, the greatest distance of images of the vertex from the
/// surface; `surface`, 0 for the surface and the next numbers for planes of reflection and axes of rotation, if there
/// are any; generatorN_x, generatorN_y, generatorN_z, the velocity of the vertex under each continuous symmetry.
Annotated_mesh_3<Kernel> surface_with_symmetries(const Indexed_triangle_mesh_3<Kernel>& surface,
                                                 const Affine_symmetries_3<Kernel>& symmetries,
                                                 const Distances_of_points& distances);

} // namespace equiaffine

#endif
