// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_REGISTER_SURFACES_H
#define EQUIAFFINE_REGISTRATION_REGISTER_SURFACES_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/function/internal/explain_misuse.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/internal/triangles_of.h>
#include <equiaffine/registration/Map_kind.h>
#include <equiaffine/registration/Surface_registration_3.h>
#include <equiaffine/registration/internal/registration_of.h>
#include <equiaffine/registration/internal/requests.h>
#include <equiaffine/registration/internal/searches.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/tags.h>

#include <ranges>

namespace equiaffine {

/// Finds the maps that move the surface `source`, or a part of it, onto the surface `target`. Each surface is a
/// function and a range of points on its zero set, which are moved onto it if they are near; the functions are of any
/// models of the concept, and defined on their boxes.
///
/// The affine frame at one generic point of the source and that at its counterpart give the map, or the frames of the
/// principal directions for maps that keep angles. Counterparts are found by their signatures: the nearest ones among
/// the points of the target, by a tree, then exactly, by Newton's steps on the target. A map is judged by the distances
/// of points both ways, refined by least squares, and accepted if fewer than 1e-6 as good ones are expected by chance:
/// neither an overlap nor the absence of other things is assumed. Points lie on the other surface if they are within
/// the noise, which is that of the given points: `tolerance` is 8 times their median distance from the zero sets, at
/// least 1e-5 of the size of the target, and at most 3e-3 of it, since large parts of unrelated surfaces can be moved
/// onto each other to within more. Where the frame of a point is not determined, as the affine one on quadrics, it is
/// not matched: surfaces with continuous symmetries have a slippage, see Surface_registration_3. A fit
/// (Fitted_function_traits_3) estimates its errors: points where its curvatures are uncertain are tried later. Whole
/// surfaces of other functions without such frames, as boxes, are matched as meshes are.
///
/// Takes 5 expansions for each of up to 6000 points of a surface, and a number of hypotheses that does not depend on
/// the number of points. The result is the same for CGAL::Sequential_tag and CGAL::Parallel_tag, bit for bit.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `map_kind` | Map_kind | AFFINE | the kind of maps that are sought |
/// | `reflections` | `bool` | `true` | whether maps may have a negative determinant |
/// | `number_of_maps` | `std::size_t` | 1 | the greatest number of maps; with more than 1 the search goes on |
/// | `least_overlap` | `double` | 0.05 | part of the points of one surface that lies on the other |
/// | `tolerance` | `double` | see above | distance of equal surfaces, a part of the size of the target |
/// | `refined_functions` | `std::pair` | source and target | functions on which maps are refined and judged |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// `refined_functions` are unsmoothed ones where those by which points are matched are smoothed, since smoothing does
/// not commute with affine maps.
/// \throw std::invalid_argument if a surface has no points, or a parameter makes no sense.
template <class ConcurrencyTag = CGAL::Sequential_tag, ImplicitFunctionTraits_3 Source, std::ranges::input_range Points,
          ImplicitFunctionTraits_3 Target, std::ranges::input_range Target_points,
          internal::Parameter_chain... Parameters>
Surface_registration_3<Kernel_of<Target>> register_surfaces(const Source& source, const Points& source_points,
                                                            const Target& target, const Target_points& target_points,
                                                            const Parameters&... given) {
  internal::check_registration_parameters<internal::Joined_parameters<Parameters...>,
                                          internal::Refined_functions_tag>();
  const auto parameters = internal::joined_parameters(given...);
  return internal::in_kernel<Kernel_of<Target>>(
      internal::registration_of<ConcurrencyTag>(source, source_points, target, target_points, parameters).result);
}

/// The same for the triangles of two meshes, without any curvature: boxes and other CAD parts have none to go by.
///
/// If the whole surfaces are equal, the map keeps the centroid of the area, and an affine one the moments of the solid
/// inside, so that all rotations and reflections about the centroid are searched by branch and bound. Else pieces are
/// matched by similarities: two points with their normals give a frame, pairs of points with about the same distance
/// and angles are tried, and a map is accepted if the points in contact leave it no freedom, at most 2 % of the points
/// of one surface lie off the other although that does not end there (`contradictions`), and fewer than 1e-6 as good
/// maps are expected by chance. The `tolerance` is the rms distance of surfaces that are equal, a part of the size; by
/// default it is what facets explain, 0.3 % to 1 %, and 2e-5 for solids of planes, which have no other facets. Without
/// one, two scans of an object that are not equal, such as a fine and a coarse one, are matched if one map stands out:
/// its rms is below 1.5 % of the size, less for thin surfaces, and less than half of that of every other map, and less
/// than 10 % of the points are off the other surface.
///
/// Takes some 5 to 40 s on one core if the wholes are not equal. The last argument has `vertex_point_map` and
/// `geom_traits` for the target; parameters::joined() makes one argument of several. The one before it has
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `map_kind` | Map_kind | AFFINE | the kind of maps that are sought |
/// | `reflections` | `bool` | `true` | whether maps may have a negative determinant |
/// | `number_of_maps` | `std::size_t` | 1 | the greatest number of maps; with more than 1 the search goes on |
/// | `least_overlap` | `double` | 0.05 | part of the points of one surface that lies on the other |
/// | `tolerance` | `double` | see above | rms distance of equal surfaces, a part of the size |
/// | `vertex_point_map` | property map | the mesh's own | from vertices of the source to points |
/// | `geom_traits`, `verbose` | as in CGAL |  | nothing depends on them |
///
/// \throw std::invalid_argument if a coordinate is not finite, a mesh has no faces, or a parameter makes no sense.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Source, Face_graph Target,
          internal::Parameter_chain Parameters = internal::No_parameters,
          internal::Parameter_chain Target_parameters = internal::No_parameters>
auto register_surfaces(const Source& source, const Target& target, const Parameters& given = {},
                       const Target_parameters& given_of_target = {}) {
  internal::check_registration_parameters<internal::Joined_parameters<Parameters>, internal::Vertex_point_tag>();
  internal::check_parameters<internal::Joined_parameters<Target_parameters>, internal::Vertex_point_tag,
                             internal::Geom_traits_tag>();
  const auto parameters = internal::joined_parameters(given);
  const auto target_parameters = internal::joined_parameters(given_of_target);
  using Point = Point_of_vertices<const Target, internal::Joined_parameters<Target_parameters>>;
  using Kernel_of_points = typename CGAL::Kernel_traits<Point>::Kernel;
  return internal::in_kernel<Kernel_of_points>(internal::registration_of_triangles(
      runs_in_threads<ConcurrencyTag>(), internal::triangles_of_graph(source, parameters),
      internal::triangles_of_graph(target, target_parameters), internal::registration_request(parameters)));
}

/// The same for points with polygons between them, each a range of positions of points. Equal points count once.
/// \throw std::invalid_argument also if a polygon has the position of no point.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points,
          std::ranges::input_range Polygons, std::ranges::input_range Target_points,
          std::ranges::input_range Target_polygons, internal::Parameter_chain... Parameters>
auto register_surfaces(const Points& points, const Polygons& polygons, const Target_points& target_points,
                       const Target_polygons& target_polygons, const Parameters&... given) {
  internal::check_registration_parameters<internal::Joined_parameters<Parameters...>>();
  const auto parameters = internal::joined_parameters(given...);
  using Kernel_of_points = typename CGAL::Kernel_traits<std::ranges::range_value_t<Target_points>>::Kernel;
  return internal::in_kernel<Kernel_of_points>(internal::registration_of_triangles(
      runs_in_threads<ConcurrencyTag>(), internal::triangles_of_soup(points, polygons),
      internal::triangles_of_soup(target_points, target_polygons), internal::registration_request(parameters)));
}

/// \cond
// A call that is mistaken, see explain_misuse.h.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Source, Face_graph Target, class... Others>
void register_surfaces(const Source&, const Target&,
                       const Others&...) requires(!(internal::Parameter_chain<Others> && ...) ||
                                                  sizeof...(Others) > 2) {
  internal::explain_parameters<Others...>();
  static_assert(sizeof...(Others) <= 2, "there is one chain of named parameters for the source and one for the target: "
                                        "parameters::joined() makes one of several");
}
/// \endcond

} // namespace equiaffine

#endif
