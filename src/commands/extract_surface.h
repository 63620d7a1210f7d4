// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_COMMANDS_EXTRACT_SURFACE_H
#define EQUIAFFINE_SRC_COMMANDS_EXTRACT_SURFACE_H

#include "request/options.h"
#include "source/source.h"
#include <equiaffine/Level_set_traits_3.h>
#include <equiaffine/marching_cubes.h>

#include <CGAL/tags.h>

namespace equiaffine {

/// Marching Cubes on the grid of a source, with all threads.
template <class Traits>
Isosurface_3<Kernel> extract_surface(const Level_set_traits_3<Traits>& function, const Source_options& options,
                                     Vertex_position vertices) {
  const auto parameters = parameters::vertex_position(vertices).number_of_nodes(
      options.resolution.value_or(default_resolution(options.kind)));
  if constexpr (is_fit<Traits>)
    return marching_cubes<CGAL::Parallel_if_available_tag>(function, parameters.skip_empty_space());
  else return marching_cubes<CGAL::Parallel_if_available_tag>(function, parameters);
}

} // namespace equiaffine

#endif
