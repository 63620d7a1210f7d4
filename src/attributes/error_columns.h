// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_ATTRIBUTES_ERROR_COLUMNS_H
#define EQUIAFFINE_SRC_ATTRIBUTES_ERROR_COLUMNS_H

#include "system/kernel.h"
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <array>
#include <span>
#include <string_view>

namespace equiaffine {

struct Source;
struct Source_options;

/// The columns that add_error_columns adds.
inline constexpr std::array<std::string_view, 2> error_attributes = {"affine_gaussian_curvature_error",
                                                                     "affine_mean_curvature_error"};

/// Adds estimates of the errors of affine curvatures at points of a surface of the source, if it has them.
void add_error_columns(const Source& source, const Source_options& options, std::span<const Kernel::Point_3> points,
                       Vertex_attributes& attributes);

} // namespace equiaffine

#endif
