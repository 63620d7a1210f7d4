// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_FIT_VERTICES_H
#define EQUIAFFINE_PROGRAM_SOURCE_FIT_VERTICES_H

#include "request/options.h"
#include "source/source_function.h"
#include "system/kernel.h"
#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/mesh/Annotated_mesh_3.h>

#include <vector>

namespace equiaffine {

/// Fits polynomials to the vertices of a mesh or to points, with all threads, and returns the structures there. The
/// columns nx, ny, nz of points without faces are their normals, if each of them has a direction.
std::vector<Fitted_structure_3<double>> fit_vertices(const Annotated_mesh_3<Kernel>& mesh, const Fit_options& options,
                                                     Orientation_of_level_set orientation);

/// Returns the part of points without faces whose normal, from the columns nx, ny, nz, is opposed to that of the nearest
/// other point; 0 without normals.
double part_with_opposed_normals(const Annotated_mesh_3<Kernel>& mesh);

/// Blends polynomials fitted to the vertices of a mesh or to points, with all threads, into one function.
Fit_traits blend_vertices(const Annotated_mesh_3<Kernel>& mesh, const Fit_options& options);

} // namespace equiaffine

#endif
