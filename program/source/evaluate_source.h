// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates a source at many points in parallel. Formulas and splines use vector instructions, except with the paper's
// estimators. Fits do not, since the order of sums in their linear algebra would depend on the instruction set.
#ifndef EQUIAFFINE_PROGRAM_SOURCE_EVALUATE_SOURCE_H
#define EQUIAFFINE_PROGRAM_SOURCE_EVALUATE_SOURCE_H

#include "source/source_function.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/geometry/Point_status.h>
#include <equiaffine/geometry/reference_estimators.h>
#include <equiaffine/marching_cubes/Marching_cubes_options.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <span>

namespace equiaffine {

/// Runs Marching Cubes; for samples, on their lattice.
Isosurface_3<Kernel> isosurface_of_source(const Source_function& function, double isovalue,
                                          const Marching_cubes_options& options);

/// Returns attributes of the level set through each point, whatever the value of f there. For `sampled` see
/// compute_attributes().
Vertex_attributes attributes_of_source(const Source_function& function, Orientation_of_level_set orientation,
                                       std::span<const Kernel::Point_3> points, const Attribute_selection& selection,
                                       Estimator estimator, const Sampled_vertices& sampled = {});

/// The maximum distance of the points from the level set, to first order.
double max_distance_to_source(const Source_function& function, double isovalue, Orientation_of_level_set orientation,
                              std::span<const Kernel::Point_3> points, std::span<const Point_status> status);

} // namespace equiaffine

#endif
