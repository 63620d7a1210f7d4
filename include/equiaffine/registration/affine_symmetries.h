// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_AFFINE_SYMMETRIES_H
#define EQUIAFFINE_REGISTRATION_AFFINE_SYMMETRIES_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/Any_function_3.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/internal/triangles_of.h>
#include <equiaffine/registration/Affine_symmetries_3.h>
#include <equiaffine/registration/Map_kind.h>
#include <equiaffine/registration/internal/registration_of.h>
#include <equiaffine/registration/internal/requests.h>
#include <equiaffine/registration/internal/searches.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

#include <ranges>

namespace equiaffine {

/// Finds all maps of a kind that move a surface, given by a function and points on its zero set, onto itself as a set
/// of points, whichever way its normals point.
///
/// On a smooth surface they come from affine frames of a few points and of all their possible images, by exact
/// derivatives; products complete the group. Where there are too few such frames, as on planes, cylinders and spheres,
/// with `complete`, or with a `tolerance` above 1e-6, all rotations and reflections about the centroid of the area,
/// which every symmetry of a whole surface keeps, are searched by branch and bound, for affine maps in coordinates in
/// which the solid inside is round, with points by random lines (Crofton). Maps are refined by least squares.
///
/// What is stated is a group, and EXACT means that the images of some 30,000 points by each of its maps are on the
/// surface to rounding; `spacing` says how far these points are apart. A surface that leaves the box of the function has
/// the symmetries that keep its piece in the box, and others if they are a group, which were verified where images are
/// in the box; see `order_in_box`.
///
/// The order counts the maps that are exact, and those to within `tolerance`, a part of the size, if it is given or none
/// is exact; it is 1e-8 then by default. A larger tolerance never finds fewer. Where the surface has continuous
/// symmetries of the kind, the result has their generators, and no others are sought: an ellipsoid has infinitely many
/// affine symmetries, but 8 rigid ones if its axes differ.
///
/// Takes some 0.5 s for a smooth formula, else 1 to 10 s on one core. The result is the same for CGAL::Sequential_tag
/// and CGAL::Parallel_tag.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `map_kind` | Map_kind | AFFINE | the kind of maps that are sought |
/// | `reflections` | `bool` | `true` | whether maps may have a negative determinant |
/// | `tolerance` | `double` | see above | rms distance by which maps may move points off, a part of the size |
/// | `complete` | `bool` | `false` | whether all rotations are searched where frames decide, too |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// \throw std::invalid_argument if there are no points, or a parameter makes no sense.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Traits, std::ranges::input_range Points,
          internal::Parameter_chain... Parameters>
Affine_symmetries_3<Kernel_of<Traits>> affine_symmetries(const Traits& traits, const Points& points,
                                                         const Parameters&... given) {
  internal::check_map_parameters<internal::Joined_parameters<Parameters...>, internal::Complete_tag>();
  const auto parameters = internal::joined_parameters(given...);
  return internal::in_kernel<Kernel_of<Traits>>(internal::symmetries_of_function(
      runs_in_threads<ConcurrencyTag>(), {Any_function_3::make(traits), internal::vectors_of(points)},
      internal::symmetry_request(parameters)));
}

/// The same for the triangles of a mesh; other faces are cut into triangles. Two corners, at which the angles of the faces
/// do not add up to that of a plane, determine a map together with their images, so that up to 1000 exact symmetries are
/// found; others come from all rotations. Each map is verified at each vertex and facet, or at millions of points of a
/// very large mesh. EXACT means to the rounding of the coordinates, as they were written; a mesh that also turns about an
/// axis to within the distance between its facets and a smooth surface has `continuous` with an `rms`. Without
/// a `tolerance` the order is that of the first level within 1 % of the size, less for thin surfaces. Small holes are
/// closed for the moments by which affine maps are found; if a mesh bounds no solid, its rigid symmetries are the result,
/// see `kind`.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `map_kind` | Map_kind | AFFINE | the kind of maps that are sought |
/// | `reflections` | `bool` | `true` | whether maps may have a negative determinant |
/// | `tolerance` | `double` | none | rms distance by which maps may move points off, a part of the size |
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// \throw std::invalid_argument if a coordinate is not finite, the mesh has no area, or a parameter makes no sense.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Graph, internal::Parameter_chain... Parameters>
auto affine_symmetries(const Graph& mesh, const Parameters&... given) {
  internal::check_map_parameters<internal::Joined_parameters<Parameters...>, internal::Vertex_point_tag>();
  const auto parameters = internal::joined_parameters(given...);
  using Point = Point_of_vertices<const Graph, internal::Joined_parameters<Parameters...>>;
  using Kernel_of_points = typename CGAL::Kernel_traits<Point>::Kernel;
  const internal::Triangles_3 triangles = internal::triangles_of_graph(mesh, parameters);
  return internal::in_kernel<Kernel_of_points>(internal::symmetries_of_triangles(
      runs_in_threads<ConcurrencyTag>(), triangles, internal::map_request(parameters)));
}

/// The same for points with polygons between them, each a range of positions of points. Equal points count once. There
/// is no `vertex_point_map`.
/// \throw std::invalid_argument also if a polygon has the position of no point.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          std::ranges::input_range Polygons, internal::Parameter_chain... Parameters>
auto affine_symmetries(const Points& points, const Polygons& polygons,
                       const Parameters&... given) requires(!ImplicitFunctionTraits_3<Points> && !Face_graph<Points>) {
  internal::check_map_parameters<internal::Joined_parameters<Parameters...>>();
  const auto parameters = internal::joined_parameters(given...);
  using Kernel_of_points = typename CGAL::Kernel_traits<std::ranges::range_value_t<Points>>::Kernel;
  const internal::Triangles_3 triangles = internal::triangles_of_soup(points, polygons);
  return internal::in_kernel<Kernel_of_points>(internal::symmetries_of_triangles(
      runs_in_threads<ConcurrencyTag>(), triangles, internal::map_request(parameters)));
}

} // namespace equiaffine

#endif
