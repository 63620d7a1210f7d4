// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_COMMANDS_REMOVE_COMPONENTS_H
#define EQUIAFFINE_COMMANDS_REMOVE_COMPONENTS_H

#include "request/options.h"
#include "source/source_function.h"
#include "system/kernel.h"
#include <equiaffine/mesh/Isosurface_3.h>

#include <cstddef>
#include <vector>

namespace equiaffine {

/// Removes the parts of the zero set of a fit that have a border and are no larger than what the band of one point
/// reaches: crumbs beside the border of the surface, where the band is ragged. A polynomial needs the points of a
/// larger part.
void remove_crumbs(Isosurface_3<Kernel>& surface, const Fit_traits& fit, const Source_options& options);

/// Keeps the connected components with the greatest areas, and `values`, one per vertex or none, of their vertices.
/// Returns how many components are left out.
std::size_t keep_largest(Isosurface_3<Kernel>& surface, std::size_t count, std::vector<double>& values);

} // namespace equiaffine

#endif
