// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_H
#define EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/marching_cubes/Vertex_position.h>
#include <equiaffine/marching_cubes/internal/lattice_function.h>
#include <equiaffine/marching_cubes/internal/lattice_isosurface.h>
#include <equiaffine/surface/Isosurface_3.h>

#include <CGAL/tags.h>

#include <array>
#include <cstddef>

namespace equiaffine {

/// The zero set of a function, by Marching Cubes (Lorensen, Cline 1987): a triangle mesh with a vertex on every edge of
/// a node grid at whose ends the function has different signs. A value of zero counts as positive. The grid is the
/// lattice of a model of LatticeImplicitFunctionTraits_3, else `sampling_lattice(traits, number_of_nodes)`.
///
/// The mesh is an oriented 2-manifold for every input, with boundary where the surface leaves the grid or meets a node
/// without a value (NaN); parts that touch there have vertices of their own. Normals point along the gradient. Its
/// topology is exactly that of the zero set of the values' trilinear interpolant, zeros taken as positive; cells whose
/// signs leave it open have vertices inside where a tunnel or a curved disc needs them. Projection does not change it,
/// and undoes moves that turn a triangle over or leave it without area. Where the surface passes through nodes,
/// triangles without area are contracted or opened and components without area dropped. All this is counted in
/// `repairs`. Nothing is found where the surface crosses no grid edge.
///
/// Named parameters: `number_of_nodes` (64), `vertex_position` (PROJECTED), `skip_empty_space` (not given).
/// The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit. Time: one evaluation per node,
/// of those near the surface when empty space is skipped; 4 more per vertex, and 4 to 6 with gradient. Memory: output,
/// one bit per node, and what some planes of nodes need.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          class NamedParameters = internal::No_parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes(const Traits& traits, const NamedParameters& parameters = {}) {
  internal::check_parameters<NamedParameters, internal::Number_of_nodes_tag, internal::Vertex_position_tag,
                             internal::Skip_empty_space_tag>();
  constexpr std::array<std::size_t, 3> default_number_of_nodes = {64, 64, 64};
  constexpr bool skips_empty_space = internal::has_parameter<internal::Skip_empty_space_tag, NamedParameters>;
  const auto position = internal::get_parameter<internal::Vertex_position_tag>(parameters, Vertex_position::PROJECTED);
  const auto lattice = [&] {
    if constexpr (LatticeImplicitFunctionTraits_3<Traits>) {
      return traits.lattice();
    } else {
      const auto nodes = internal::get_parameter<internal::Number_of_nodes_tag>(parameters, default_number_of_nodes);
      return sampling_lattice(traits, nodes);
    }
  }();
  return internal::isosurface_on_lattice<ConcurrencyTag, skips_empty_space>(internal::Lattice_function(traits, lattice),
                                                                            position);
}

} // namespace equiaffine

#endif
