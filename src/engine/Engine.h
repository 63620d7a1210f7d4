// SPDX-License-Identifier: GPL-3.0-or-later
// The functions that engine_entry.cpp defines for one instruction set. The entry points have C linkage, so that the
// build can recognize them in the object files (see CMakeLists.txt).
#ifndef EQUIAFFINE_SRC_ENGINE_ENGINE_H
#define EQUIAFFINE_SRC_ENGINE_ENGINE_H

#include <equiaffine/engine/vectorized.h>

#include <span>
#include <tuple>

namespace equiaffine::vectorized {

/// The functions for level sets of one type.
template <class Function>
struct Engine {
  using Level_set = Level_set_traits_3<Function>;
  using Points = std::span<const Kernel::Point_3>;
  using Statuses = std::span<const Point_status>;

  Isosurface_3<Kernel> (*marching_cubes)(const Level_set&, const Marching_cubes_options&);
  Vertex_attributes (*compute_attributes)(const Level_set&, Points, const Attribute_selection&,
                                          const Sampled_vertices&);
  double (*max_distance_to_surface)(const Level_set&, Points, Statuses);
};

using Engines = std::tuple<Engine<Formula>, Engine<Spline>>;

} // namespace equiaffine::vectorized

extern "C" {
const equiaffine::vectorized::Engines* equiaffine_engines_baseline();
const equiaffine::vectorized::Engines* equiaffine_engines_avx2();
const equiaffine::vectorized::Engines* equiaffine_engines_avx512();
}

#endif
