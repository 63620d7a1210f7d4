// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_COMMANDS_REMOVE_CRUMBS_H
#define EQUIAFFINE_COMMANDS_REMOVE_CRUMBS_H

#include "request/options.h"
#include "source/source_function.h"
#include "system/kernel.h"
#include <equiaffine/surface/Isosurface_3.h>

namespace equiaffine {

/// Removes the parts of the zero set of a fit that have a border and are no larger than what the band of one point
/// reaches: crumbs beside the border of the surface, where the band is ragged. A polynomial needs the points of a
/// larger part.
void remove_crumbs(Isosurface_3<Kernel>& surface, const Fit_traits& fit, const Source_options& options);

} // namespace equiaffine

#endif
