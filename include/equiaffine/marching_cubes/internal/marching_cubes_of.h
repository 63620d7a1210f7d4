// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_MARCHING_CUBES_OF_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_MARCHING_CUBES_OF_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/capabilities.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/marching_cubes/Vertex_position.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/internal/lattice_isosurface.h>
#include <equiaffine/mesh/Isosurface_3.h>

#include <array>
#include <cstddef>

namespace equiaffine::internal {

template <class Parameters, class... OtherTags>
constexpr void check_marching_cubes_parameters() {
  check_parameters<Parameters, Number_of_nodes_tag, Vertex_position_tag, Skip_empty_space_tag, Geom_traits_tag,
                   Verbose_tag, OtherTags...>();
}

/// Returns run<SkipsEmptySpace>(function, position) for what the named parameters of marching_cubes() say.
template <class Traits, class Parameters, class Run>
auto with_marching_cubes_of(const Traits& traits, const Parameters& parameters, const Run& run) {
  constexpr std::array<std::size_t, 3> default_number_of_nodes = {64, 64, 64};
  constexpr bool skips_empty_space = has_parameter<Skip_empty_space_tag, Parameters>;
  const auto position = get_parameter<Vertex_position_tag>(parameters, Vertex_position::PROJECTED);
  const auto lattice = [&]() -> Lattice_3<Kernel_of<Traits>> {
    if constexpr (LatticeImplicitFunctionTraits_3<Traits>) return traits.lattice();
    else return sampling_lattice(traits, get_parameter<Number_of_nodes_tag>(parameters, default_number_of_nodes));
  }();
  return run.template operator()<skips_empty_space>(Lattice_function(traits, lattice), position);
}

/// The function marching_cubes() with all its named parameters in one chain, which may have others.
template <class ConcurrencyTag, class Traits, class Parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes_of(const Traits& traits, const Parameters& parameters) {
  return with_marching_cubes_of(
      traits, parameters, []<bool SkipsEmptySpace>(const auto& function, Vertex_position position) {
        return isosurface_on_lattice<ConcurrencyTag, SkipsEmptySpace>(function, position).surface;
      });
}

} // namespace equiaffine::internal

#endif
