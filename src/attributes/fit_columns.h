// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_ATTRIBUTES_FIT_COLUMNS_H
#define EQUIAFFINE_SRC_ATTRIBUTES_FIT_COLUMNS_H

#include "request/options.h"
#include "system/kernel.h"
#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/io/Annotated_mesh_3.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// Two standard deviations of what noise makes of the affine curvatures, beside the estimates `error_attributes` of the
/// whole errors.
inline constexpr std::array<std::string_view, 2> noise_attributes = {"affine_gaussian_curvature_noise",
                                                                     "affine_mean_curvature_noise"};

/// Fits polynomials to the vertices, with all threads. The columns nx, ny, nz of points without faces are their normals,
/// if each of them has a direction.
std::vector<Fitted_structure_3<double>> fit_vertices(const Annotated_mesh_3<Kernel>& mesh, const Fit_options& options,
                                                     Orientation_of_level_set orientation);

/// The selected attributes of the structures.
Vertex_attributes attributes_of(std::span<const Fitted_structure_3<double>> structures,
                                const Attribute_selection& selection);

/// Adds those of the columns `error_attributes` and `noise_attributes` that `names` has and `attributes` has not.
void add_estimates(std::span<const Fitted_structure_3<double>> structures, const std::vector<std::string>& names,
                   Vertex_attributes& attributes);

} // namespace equiaffine

#endif
