// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings about samples and fits whose results may not be what the user expects.
#ifndef EQUIAFFINE_PROGRAM_SOURCE_WARNINGS_H
#define EQUIAFFINE_PROGRAM_SOURCE_WARNINGS_H

#include "source/source.h"
#include "system/progress.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/attributes/Fit_statistics.h>
#include <equiaffine/fit/Close_sheets.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <cstddef>
#include <string>
#include <vector>

namespace equiaffine {

/// Warns that `outside` of `all` points are outside the samples or the data, if the user may not expect the reason: a
/// narrow band, too few nodes for the spline, or distance from the data of a fit. `points` is the word for them, such
/// as "vertices".
void warn_of_outside(const Source_options& options, const Source& source, std::size_t outside, std::size_t all,
                     const std::string& points, Progress& progress);

/// Warns if unsmoothed samples have few distinct values: their curvatures are those of the steps.
void warn_of_steps(const Spline_statistics& spline, Progress& progress);

/// Whether columns depend on derivatives of order 3 or 4.
bool has_affine_curvatures(const Attribute_selection& attributes, const std::vector<std::string>& estimates);

/// Warns of the doubts_of() a fit. `are_data` states whether the vertices are those of the data or of a surface.
void warn_of_doubt(const Fit_statistics& fit, const Fit_options& options, bool has_affine_curvatures, bool are_data,
                   Progress& progress);

/// Warns if the grid is too coarse to separate sheets of the data of a fit.
void warn_of_close_sheets(const Close_sheets& sheets, Progress& progress);

/// Warns if given normals of points are inconsistent.
void warn_of_opposed_normals(const Annotated_mesh_3<Kernel>& points, Progress& progress);

} // namespace equiaffine

#endif
