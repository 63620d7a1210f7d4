// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_H
#define EQUIAFFINE_MARCHING_CUBES_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/capabilities.h>
#include <equiaffine/marching_cubes/Vertex_position.h>
#include <equiaffine/marching_cubes/internal/grid/lattice_function.h>
#include <equiaffine/marching_cubes/internal/lattice_isosurface.h>
#include <equiaffine/surface/Isosurface_3.h>

#include <CGAL/tags.h>

#include <array>
#include <cstddef>

namespace equiaffine {

/// Meshes the zero set of a function by Marching Cubes (Lorensen, Cline 1987). The result is a triangle mesh with a
/// vertex on every edge of a node grid at whose ends the function has different signs. A value of zero counts as
/// positive. The grid is the lattice of a model of LatticeImplicitFunctionTraits_3, else
/// `sampling_lattice(traits, number_of_nodes)`.
///
/// The mesh is an oriented 2-manifold for every input, with boundary where the surface leaves the grid or meets a node
/// without a value (NaN); parts that touch there have vertices of their own. Normals point along the gradient. The
/// topology is exactly that of the zero set of the trilinear interpolant of the values, where zero counts as positive.
/// To have it, ambiguous cells get vertices inside for a tunnel or a curved disc. Projection does not change the
/// topology: a move that would turn a triangle over or leave it without area is undone. Where the surface passes
/// through nodes, triangles without area are contracted or opened, and components without area are dropped. `repairs`
/// counts all this. Parts of the surface that cross no edge of the grid are not found.
///
/// Where the sign changes along an edge at a pole, which projection finds since |f| grows towards it, the vertex is
/// removed with the triangles around it: the surface ends there, and the mesh is empty if there are only poles. So it is
/// where f, or its derivatives, cease to exist between two nodes and no zero is found. With
/// LINEAR vertices poles are not told from zeros. A vertex that could not be projected, as at a jump, stays at its linear
/// position, is UNCONVERGED, and may be far from the surface.
///
/// Named parameters: `number_of_nodes` (64), `vertex_position` (PROJECTED), `skip_empty_space` (not given).
/// The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit. Takes one evaluation per node
/// (if empty space is skipped, per node near the surface), and per vertex 4 more and 4 to 6 with gradient. The memory
/// in use is the output, one bit per node, and a buffer for some planes of nodes.
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
