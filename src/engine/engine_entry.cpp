// SPDX-License-Identifier: GPL-3.0-or-later
// The library's templates, compiled for one instruction set.
#include "engine/Engine.h"
#include <equiaffine/attributes/attributes.h>
#include <equiaffine/marching_cubes/marching_cubes.h>
#include <equiaffine/surface/distance_to_surface.h>

#include <CGAL/tags.h>

namespace equiaffine::vectorized {

namespace {

using Tag = CGAL::Parallel_if_available_tag;

template <class Function>
Isosurface_3<Kernel> isosurface(const Level_set_traits_3<Function>& level_set, const Marching_cubes_options& options) {
  return equiaffine::marching_cubes<Tag>(level_set, options);
}

template <class Function>
Vertex_attributes attributes(const Level_set_traits_3<Function>& level_set, std::span<const Kernel::Point_3> points,
                             const Attribute_selection& selection, const Sampled_vertices& sampled) {
  return equiaffine::compute_attributes<Tag>(level_set, points, selection, sampled);
}

template <class Function>
constexpr Engine<Function> engine() {
  return {isosurface<Function>, attributes<Function>,
          equiaffine::max_distance_to_surface<Tag, Level_set_traits_3<Function>>};
}

} // namespace

} // namespace equiaffine::vectorized

const equiaffine::vectorized::Engines* EQUIAFFINE_ENTRY() {
  using namespace equiaffine::vectorized;
  static constexpr Engines engines = {engine<Formula>(), engine<Spline>()};
  return &engines;
}
