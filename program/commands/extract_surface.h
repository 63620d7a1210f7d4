// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_COMMANDS_EXTRACT_SURFACE_H
#define EQUIAFFINE_PROGRAM_COMMANDS_EXTRACT_SURFACE_H

#include "request/options.h"
#include "source/source_function.h"
#include <equiaffine/marching_cubes/Vertex_position.h>
#include <equiaffine/mesh/Isosurface_3.h>

namespace equiaffine {

/// Marching Cubes on the grid of a source, with all threads and vector instructions.
Isosurface_3<Kernel> extract_surface(const Source_function& function, double isovalue, const Source_options& options,
                                     Vertex_position vertices);

} // namespace equiaffine

#endif
