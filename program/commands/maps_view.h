// SPDX-License-Identifier: GPL-3.0-or-later
// These functions make the meshes by which pages, pictures and files show maps of surfaces.
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_MAPS_VIEW_H
#define EQUIAFFINE_PROGRAM_COMMANDS_MAPS_VIEW_H

#include "commands/Surface_to_register.h"
#include <equiaffine/mesh/Annotated_mesh_3.h>
#include <equiaffine/registration/Affine_symmetries_3.h>
#include <equiaffine/registration/Surface_registration_3.h>

#include <array>
#include <functional>
#include <vector>

namespace equiaffine {

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
