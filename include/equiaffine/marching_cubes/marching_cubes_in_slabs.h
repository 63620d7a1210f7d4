// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_IN_SLABS_H
#define EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_IN_SLABS_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/marching_cubes/Isosurface_slab_3.h>
#include <equiaffine/marching_cubes/internal/isosurface_in_slabs.h>
#include <equiaffine/marching_cubes/internal/lattice_isosurface.h>
#include <equiaffine/volume/Cell_block.h>

#include <CGAL/tags.h>

#include <cstddef>

namespace equiaffine {

/// Meshes the zero set of a function as marching_cubes() does, one slab of planes of nodes after the other, for meshes
/// that are larger than memory. Calls visit(slab) with an `Isosurface_slab_3<Kernel>` for each one. All slabs together
/// are the mesh of marching_cubes(), bit for bit and in the same order, however many planes a slab has.
///
///     std::ofstream file("faces.txt");
///     marching_cubes_in_slabs(traits, [&](const Isosurface_slab_3<Kernel>& slab) {
///       for (const auto& [a, b, c] : slab.triangles) file << a << ' ' << b << ' ' << c << '\n';
///     });
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `planes_per_slab` | `std::size_t` | 64 | planes of nodes that a slab has |
/// | `cell_block` | Cell_block | none | asks for the mesh of these cells of the lattice only, with vertex ids |
/// | `known_cells` | Cell_block | the lattice | where the function may be evaluated |
/// | `number_of_nodes` | `std::size_t`, or an array of three | 64 | nodes along each axis, without a lattice |
/// | `vertex_position` | Vertex_position | PROJECTED | where vertices are put |
/// | `skip_empty_space` | no value | not given | asks for bounds, and evaluates near the zero set only |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// The meshes of blocks of cells, such as different machines make, are together the whole mesh: every triangle is in one
/// of them, with the same points and ids, and vertices at the sides of blocks are in all that have triangles there. Known
/// cells go `cells_around_block` beyond the block on every side, or to the end of the lattice. Where a closed part without
/// area goes on beyond all known cells, blocks do not agree on whether to drop it: its triangles may be left in some.
///
/// Takes the memory of a slab with 8 planes more, and the time of marching_cubes() for as many planes. Where a closed
/// part of the surface without area, such as a function that only touches zero has, goes on beyond these planes, the
/// slab is made again with more of them.
/// \throw std::invalid_argument unless a slab has a plane, a block has cells of the lattice, and enough cells around it
/// are known
/// \throw std::runtime_error if the repairs beside a seam depend on what is far from it, which no function was seen to
/// bring about
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, class Visit,
          internal::Parameter_chain... Parameters>
Isosurface_totals marching_cubes_in_slabs(const Traits& traits, const Visit& visit, const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_marching_cubes_parameters<Joined, internal::Planes_per_slab_tag, internal::Cell_block_tag,
                                            internal::Known_cells_tag>();
  const Joined parameters = internal::joined_parameters(given...);
  constexpr std::size_t default_planes = 64;
  const std::size_t planes = internal::get_parameter<internal::Planes_per_slab_tag>(parameters, default_planes);
  check_argument(planes > 0, "a slab has no planes: give one at least");
  return internal::with_marching_cubes_of(
      traits, parameters, [&]<bool SkipsEmptySpace>(const auto& function, Vertex_position position) {
        if constexpr (internal::has_parameter<internal::Cell_block_tag, Joined>) {
          const Cell_block all = cells_of(function.lattice().size());
          const Cell_block block = internal::get_parameter<internal::Cell_block_tag>(parameters, all),
                           known = internal::get_parameter<internal::Known_cells_tag>(parameters, all);
          internal::check_block(all, block, known);
          return internal::Isosurface_of_block<ConcurrencyTag, SkipsEmptySpace, Traits>(function, position, planes,
                                                                                        block, known)
              .run(visit);
        } else {
          static_assert(!internal::has_parameter<internal::Known_cells_tag, Joined>,
                        "known_cells() needs cell_block()");
          return internal::Isosurface_in_slabs<ConcurrencyTag, SkipsEmptySpace, Traits>(function, position, planes)
              .run(visit);
        }
      });
}

} // namespace equiaffine

#endif
