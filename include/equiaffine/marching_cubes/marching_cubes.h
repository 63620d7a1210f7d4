// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_H
#define EQUIAFFINE_MARCHING_CUBES_MARCHING_CUBES_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/marching_cubes/Vertex_position.h>
#include <equiaffine/marching_cubes/internal/lattice_isosurface.h>
#include <equiaffine/mesh/Isosurface_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/copy_to_graph.h>
#include <equiaffine/mesh/to_face_graph.h>
#include <equiaffine/surface/internal/explain_sampler.h>

#include <CGAL/tags.h>

#include <utility>

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
/// removed with the triangles around it: the surface ends there, and the mesh is empty if there are only poles. So it
/// is where f, or its derivatives, cease to exist between two nodes and no zero is found. With LINEAR vertices poles
/// are not told from zeros. A vertex that could not be projected, as at a jump, stays at its linear position, is
/// UNCONVERGED, and may be far from the surface.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `number_of_nodes` | `std::size_t`, or an array of three | 64 | nodes along each axis, without a lattice |
/// | `vertex_position` | Vertex_position | PROJECTED | where vertices are put |
/// | `skip_empty_space` | no value | not given | asks for bounds, and evaluates near the zero set only |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// Empty space can be skipped if the function is a model of BoundedImplicitFunctionTraits_3. Nothing is skipped without
/// the parameter, since whether a function written as code accepts Interval cannot be asked without an error where it
/// does not. The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit. Takes one evaluation
/// per node (if empty space is skipped, per node near the surface), and per vertex 4 more and 4 to 6 with gradient. The
/// memory in use is the output, one bit per node, and a buffer for some planes of nodes.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits,
          internal::Parameter_chain... Parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes(const Traits& traits, const Parameters&... given) {
  internal::check_marching_cubes_parameters<internal::Joined_parameters<Parameters...>>();
  return internal::marching_cubes_of<ConcurrencyTag>(traits, internal::joined_parameters(given...));
}

/// The same for the level set f = isovalue, whose points and triangles are added to containers of the caller: see
/// to_polygon_soup(). The result has no mesh, but the rest: what was repaired, and the status of each point.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, class Points, class Triangles,
          internal::Parameter_chain... Parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes(const Traits& traits, const typename Traits::FT& isovalue,
                                               Points& points, Triangles& triangles, const Parameters&... given) {
  internal::check_marching_cubes_parameters<internal::Joined_parameters<Parameters...>>();
  auto surface = internal::marching_cubes_of<ConcurrencyTag>(Level_set_traits_3<Traits>(traits, isovalue),
                                                             internal::joined_parameters(given...));
  to_polygon_soup(surface, points, triangles);
  return internal::without_mesh(std::move(surface));
}

/// The same for the zero set, which is added to a model of CGAL's MutableFaceGraph: see to_face_graph(). Vertices are made
/// in the order of the points, which is that of `vertex_status` in the result. Further named parameters are
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
/// | `vertex_status_map` | writable property map | none | from vertices to Point_status |
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, Face_graph Graph,
          internal::Parameter_chain... Parameters>
Isosurface_3<Kernel_of<Traits>> marching_cubes(const Traits& traits, Graph& graph, const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_marching_cubes_parameters<Joined, internal::Vertex_point_tag, internal::Vertex_status_tag>();
  const Joined parameters = internal::joined_parameters(given...);
  auto surface = internal::marching_cubes_of<ConcurrencyTag>(traits, parameters);
  internal::copy_to_graph(surface, graph, parameters);
  return internal::without_mesh(std::move(surface));
}

/// \cond
// A call that is mistaken, see explain_sampler.h.
template <class ConcurrencyTag = CGAL::Sequential_tag, class Traits, class... Others>
void marching_cubes(const Traits&, const Others&...) requires Mistaken_for_sampler<void, Traits, Others...> {
  explain_sampler<void, Traits, Others...>();
}
/// \endcond

} // namespace equiaffine

#endif
