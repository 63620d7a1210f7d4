// SPDX-License-Identifier: GPL-3.0-or-later
// The engines call the library, compiled for the instruction set of the file that includes this.
#ifndef EQUIAFFINE_PROGRAM_ENGINE_ENGINE_WITH_LIBRARY_H
#define EQUIAFFINE_PROGRAM_ENGINE_ENGINE_WITH_LIBRARY_H

#include "engine/Engine.h"
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/surface/distance_to_surface.h>

#include <CGAL/tags.h>

#include <tuple>
#include <type_traits>
#include <variant>

namespace equiaffine {

template <class Traits>
Vertex_attributes attributes_with_library(const Attribute_task<Traits>& task) {
  const double isovalue = 0; // attributes do not depend on it
  const Level_set_traits_3<Traits> level_set(task.function, isovalue, task.orientation);
  return compute_attributes<CGAL::Parallel_if_available_tag>(
      level_set, task.points, task.selection, task.sampled_status, parameters::estimator(task.estimator));
}

template <class Traits>
Isosurface_3<Kernel> marching_cubes_with_library(const Level_set_traits_3<Traits>& function,
                                                 const std::array<std::size_t, 3>& nodes, Vertex_position vertices) {
  const auto parameters = parameters::vertex_position(vertices).number_of_nodes(nodes);
  if constexpr (BoundedImplicitFunctionTraits_3<Traits>)
    return marching_cubes<CGAL::Parallel_if_available_tag>(function, parameters.skip_empty_space());
  else return marching_cubes<CGAL::Parallel_if_available_tag>(function, parameters);
}

template <class Traits>
constexpr Engine<Traits> engine_with_library() {
  return {attributes_with_library<Traits>, marching_cubes_with_library<Traits>,
          max_distance_to_surface<CGAL::Parallel_if_available_tag, Level_set_traits_3<Traits>>};
}

template <class... Traits>
constexpr std::tuple<Engine<Traits>...> engines_with_library(std::type_identity<std::variant<Traits...>>) {
  return {engine_with_library<Traits>()...};
}

} // namespace equiaffine

#endif
