// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_ENGINE_ENGINE_H
#define EQUIAFFINE_PROGRAM_ENGINE_ENGINE_H

#include "source/source_function.h"
#include <equiaffine/attributes/Attribute_selection.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/geometry/Estimator.h>
#include <equiaffine/marching_cubes/Vertex_position.h>
#include <equiaffine/mesh/Isosurface_3.h>

#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <variant>
#include <vector>

namespace equiaffine {

/// The arguments of compute_attributes(). Attributes at a point are those of the level set through it, whatever the
/// value of f there.
template <class Traits>
struct Attribute_task {
  const Traits& function; ///< one of the models of Source_function
  Orientation_of_level_set orientation;
  std::span<const Kernel::Point_3> points;
  const Attribute_selection& selection;
  Estimator estimator = Estimator::COMPACT;
  std::span<const Point_status> sampled_status = {}; ///< empty, or one per point
};

/// The functions of the library that evaluate one of the models of Source_function at many points, compiled for one
/// instruction set. They use the threads that TBB may use.
template <class Traits>
struct Engine {
  Vertex_attributes (*compute_attributes)(const Attribute_task<Traits>&);

  /// Runs Marching Cubes on a grid of that many nodes, or on the lattice of the samples. It leaves out empty space if f
  /// has bounds and no samples.
  Isosurface_3<Kernel> (*marching_cubes)(const Level_set_traits_3<Traits>&, const std::array<std::size_t, 3>& nodes,
                                         Vertex_position);

  double (*max_distance_to_surface)(const Level_set_traits_3<Traits>&, std::span<const Kernel::Point_3>,
                                    std::span<const Point_status>);
};

template <class Source>
struct Engines_of;

template <class... Traits>
struct Engines_of<std::variant<Traits...>> {
  using type = std::tuple<Engine<Traits>...>;
};

/// The models of Source_function that are evaluated with vector instructions. Fits are not among them: their linear
/// algebra sums in another order for each instruction set.
using Vectorized_function = std::variant<Formula_function, Spline_function>;
using Vectorized_engines = Engines_of<Vectorized_function>::type;

/// The vector instructions that can be used. All of them give the same results, bit for bit.
enum class Instruction_set { BASELINE, AVX2, AVX512 };

/// The instruction sets that this program was compiled for and this processor has, the narrowest first.
std::vector<Instruction_set> instruction_sets();

const Vectorized_engines& vectorized_engines(Instruction_set set);
const Engine<Fit_function>& fit_engine();

/// The engine for a model of Source_function.
template <class Traits>
const Engine<Traits>& engine([[maybe_unused]] Instruction_set set = instruction_sets().back()) {
  if constexpr (is_fit<Traits>) return fit_engine();
  else return std::get<Engine<Traits>>(vectorized_engines(set));
}

} // namespace equiaffine

#endif
