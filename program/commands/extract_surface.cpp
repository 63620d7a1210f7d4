// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/extract_surface.h"

#include "engine/Engine.h"
#include "source/source.h"
#include <equiaffine/function/Level_set_traits_3.h>

#include <variant>

namespace equiaffine {

Isosurface_3<Kernel> extract_surface(const Source_function& function, double isovalue, const Source_options& options,
                                     Vertex_position vertices) {
  const auto nodes = options.resolution.value_or(default_resolution(options.kind));
  return std::visit(
      [&]<class Traits>(const Traits& f) {
        return engine<Traits>().marching_cubes(Level_set_traits_3(f, isovalue), nodes, vertices);
      },
      function);
}

} // namespace equiaffine
