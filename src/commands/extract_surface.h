// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_COMMANDS_EXTRACT_SURFACE_H
#define EQUIAFFINE_SRC_COMMANDS_EXTRACT_SURFACE_H

#include "engine/Engine.h"
#include "request/options.h"
#include "source/source.h"
#include <equiaffine/Level_set_traits_3.h>

namespace equiaffine {

/// Marching Cubes on the grid of a source, with all threads.
template <class Traits>
Isosurface_3<Kernel> extract_surface(const Level_set_traits_3<Traits>& function, const Source_options& options,
                                     Vertex_position vertices) {
  return engine<Traits>().marching_cubes(function, options.resolution.value_or(default_resolution(options.kind)),
                                         vertices);
}

} // namespace equiaffine

#endif
