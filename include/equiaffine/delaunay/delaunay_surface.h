// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_DELAUNAY_SURFACE_H
#define EQUIAFFINE_DELAUNAY_DELAUNAY_SURFACE_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/delaunay/Delaunay_criteria.h>
#include <equiaffine/delaunay/Delaunay_surface_3.h>
#include <equiaffine/delaunay/internal/delaunay_surface_of.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/copy_to_graph.h>
#include <equiaffine/mesh/to_face_graph.h>
#include <equiaffine/surface/internal/explain_sampler.h>

#include <utility>

namespace equiaffine {

/// Meshes the zero set of a function by Delaunay refinement (Boissonnat, Oudot: Provably good sampling and meshing of
/// surfaces, 2005). The result is a triangle mesh with vertices on the surface, angles of at least `criteria.angle`,
/// and normals along the gradient.
///
/// CGAL's 3D Mesh Generation refines the mesh. It starts from points on every component of the surface, which are found
/// by subdividing the domain into boxes with the interval bounds of the function. If the result `is_certified`, no
/// component was missed, however small. A closed regular surface gives a closed oriented 2-manifold.
///
/// Features are made of edges of the mesh: the curves where the surface meets the border of the clip domain,
/// `feature_curves`, and the parabolic curves, with their crossings and their ends on the border, if they are asked
/// for. Where features are nearer to each other than the radius, or meet in sharp corners, edges are shorter, and
/// angles at the corners smaller. Features nearer to each other than a fiftieth of the radius may lose edges; the mesh
/// is then not certified, and need not be manifold there. Features much smaller than the radius may be missed.
/// Nodes of the surface, such as the apex of a cone, are vertices, and so are apexes where f has no gradient, such as
/// that of half a cone or the corner of a cube. The curves where the surface ends since f is not defined beyond become
/// features, too, to a hundredth of the radius. Near other singular points the mesh ends in facets of radius/8,
/// whatever their angles.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `clip` | Clip_domain_3 | the box of the function | where the surface is looked for |
/// | `facet_sizing` | Facet_sizing | UNIFORM | how the size of facets varies |
/// | `feature_curves` | range of Polyline_3 | none | curves on the surface that edges follow |
/// | `parabolic_features` | no value | not given | edges follow the parabolic curves |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// Segments of `feature_curves` are short beside the facets; the mesh has vertices of its own on them. With
/// `parabolic_features` no triangle has points on both sides of a parabolic curve, where the affine curvatures are
/// infinite.
/// \throw std::invalid_argument unless the angle lies in [0, 30], the lengths are positive, or 0 for their defaults,
/// and finite, the clip domain has an interior and is finite, the diagonal of its box is at least 1e-40 and, as its
/// coordinates, at most 1e40, and the radius is at least 1024 epsilons of the greatest coordinate
///
/// The result is the same on every run. One thread computes it: 20,000 triangles take about 0.2 seconds, and 10 to 40
/// evaluations per triangle.
template <ImplicitFunctionTraits_3 Traits, internal::Parameter_chain... Parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface(const Traits& traits, const Delaunay_criteria& criteria,
                                                       const Parameters&... given) {
  internal::check_delaunay_parameters<internal::Joined_parameters<Parameters...>>();
  return internal::delaunay_surface_of(traits, criteria, internal::joined_parameters(given...));
}
/// The same with the default criteria.
template <ImplicitFunctionTraits_3 Traits, internal::Parameter_chain... Parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface(const Traits& traits, const Parameters&... given) {
  return delaunay_surface(traits, Delaunay_criteria(), given...);
}

/// The same for the level set f = isovalue, whose points and triangles are added to containers of the caller: see
/// to_polygon_soup(). The result has no mesh, but the rest.
template <ImplicitFunctionTraits_3 Traits, class Points, class Triangles, internal::Parameter_chain... Parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface(const Traits& traits, const typename Traits::FT& isovalue,
                                                       Points& points, Triangles& triangles,
                                                       const Delaunay_criteria& criteria, const Parameters&... given) {
  internal::check_delaunay_parameters<internal::Joined_parameters<Parameters...>>();
  auto surface = internal::delaunay_surface_of(Level_set_traits_3<Traits>(traits, isovalue), criteria,
                                               internal::joined_parameters(given...));
  to_polygon_soup(surface, points, triangles);
  return internal::without_mesh(std::move(surface));
}

/// The same with the default criteria.
template <ImplicitFunctionTraits_3 Traits, class Points, class Triangles, internal::Parameter_chain... Parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface(const Traits& traits, const typename Traits::FT& isovalue,
                                                       Points& points, Triangles& triangles,
                                                       const Parameters&... given) {
  return delaunay_surface(traits, isovalue, points, triangles, Delaunay_criteria(), given...);
}

/// The same for the zero set, which is added to a model of CGAL's MutableFaceGraph: see to_face_graph(). Further named
/// parameters are
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
/// | `vertex_status_map` | writable property map | none | from vertices to Point_status |
template <ImplicitFunctionTraits_3 Traits, Face_graph Graph, internal::Parameter_chain... Parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface(const Traits& traits, Graph& graph,
                                                       const Delaunay_criteria& criteria, const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_delaunay_parameters<Joined, internal::Vertex_point_tag, internal::Vertex_status_tag>();
  const Joined parameters = internal::joined_parameters(given...);
  auto surface = internal::delaunay_surface_of(traits, criteria, parameters);
  internal::copy_to_graph(surface, graph, parameters);
  return internal::without_mesh(std::move(surface));
}

/// The same with the default criteria.
template <ImplicitFunctionTraits_3 Traits, Face_graph Graph, internal::Parameter_chain... Parameters>
Delaunay_surface_3<Kernel_of<Traits>> delaunay_surface(const Traits& traits, Graph& graph, const Parameters&... given) {
  return delaunay_surface(traits, graph, Delaunay_criteria(), given...);
}

/// \cond
// A call that is mistaken, see explain_sampler.h.
template <class Traits, class... Others>
void delaunay_surface(const Traits&,
                      const Others&...) requires Mistaken_for_sampler<Delaunay_criteria, Traits, Others...> {
  explain_sampler<Delaunay_criteria, Traits, Others...>();
}
/// \endcond

} // namespace equiaffine

#endif
