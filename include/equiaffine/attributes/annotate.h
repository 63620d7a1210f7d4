// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the local structure of level sets to property maps of meshes and ranges.
#ifndef EQUIAFFINE_ATTRIBUTES_ANNOTATE_H
#define EQUIAFFINE_ATTRIBUTES_ANNOTATE_H

#include <equiaffine/attributes/attributes.h>
#include <equiaffine/attributes/internal/maps_of_columns.h>
#include <equiaffine/attributes/internal/vertex_maps.h>
#include <equiaffine/base/internal/convert_point.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/function/concepts.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/to_face_graph.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>
#include <CGAL/tags.h>

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The structure of the level set at a point of any kernel.
template <class Traits, class Point>
auto structure_at(const Traits& traits, const Point& p, Point_status before) {
  check_coordinates<Point>();
  return local_structure_at(traits, convert_point<Kernel_of<Traits>>(p), before);
}

/// The points of elements, in the kernel of the function.
template <class Traits, class Elements, class Point_of>
std::vector<typename Traits::Point_3> points_of_elements(Elements&& elements, const Point_of& point_of) {
  std::vector<typename Traits::Point_3> points;
  for (auto&& element : elements) {
    const auto& p = point_of(element);
    check_coordinates<std::decay_t<decltype(p)>>();
    points.push_back(convert_point<Kernel_of<Traits>>(p));
  }
  return points;
}

/// Fills the given maps for elements with points: vertices of a mesh, or elements of a range. Attributes are
/// computed as in compute_attributes(). Whole structures, and those of number types other than double, are computed
/// one by one in threads. Maps are read and written sequentially, because reading a boost::associative_property_map
/// may insert an element.
template <class ConcurrencyTag, class Elements, class Point_of, class Traits, class Parameters>
void annotate_elements(Elements&& elements, const Point_of& point_of, const Traits& traits,
                       const Parameters& parameters) {
  static_assert(has_maps<Parameters>(Structure_tags()),
                "annotate() has nothing to write to: give it property maps, such as "
                "parameters::vertex_affine_mean_curvature_map(map), or a CGAL::Surface_mesh that is not const");
  const auto points = points_of_elements<Traits>(elements, point_of);
  std::vector<Point_status> before;
  for (auto&& element : elements) before.push_back(status_before(parameters, element));
  if constexpr (std::is_same_v<typename Traits::FT, double> && !has_parameter<Vertex_structure_tag, Parameters>) {
    const auto attributes =
        compute_columns<ConcurrencyTag>(traits, points, selection_of_given_maps<Parameters>(Number_tags()), before);
    fill_given_maps(
        elements, parameters, [&](const std::string& name) -> const auto& { return *find_column(attributes, name); },
        Number_tags());
    fill_status_map(elements, parameters, *attributes.status);
  } else {
    constexpr std::size_t most_at_once = 1 << 16;
    std::vector<Local_structure_3<typename Traits::FT>> structures;
    std::size_t next = 0, end = 0;
    for (auto&& element : elements) {
      if (next == end) {
        end = std::min(next + most_at_once, points.size());
        structures.resize(end - next);
        parallel_for<ConcurrencyTag>(
            0, structures.size(),
            [&](std::size_t i) { structures[i] = local_structure_at(traits, points[next + i], before[next + i]); },
            256);
      }
      put_structure(parameters, element, structures[next++ % most_at_once], Structure_tags());
    }
  }
}

/// Fills the maps `v:NAME` of a surface mesh with all attributes of its vertices.
template <class ConcurrencyTag, class Mesh, class Point_of, class Traits>
void annotate_surface_mesh(Mesh& mesh, const Point_of& point_of, const Traits& traits) {
  check_mesh_for_maps<Mesh>();
  const auto points = points_of_elements<Traits>(mesh.vertices(), point_of);
  std::vector<Point_status> before;
  if (const auto status = Named_maps<Mesh>::template find<Point_status>(mesh, "v:status"))
    for (const auto v : mesh.vertices()) before.push_back((*status)[v]);
  const auto areas = areas_of_surface_mesh(mesh, points);
  const auto selection = selection_of_named_maps(!areas.empty());
  add_named_maps(mesh, mesh.vertices(), compute_columns<ConcurrencyTag>(traits, points, selection, {before, areas}));
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Writes the local structure of the level sets of f through the vertices of a mesh to property maps. The mesh is a
/// model of CGAL's VertexListGraph, with or without faces. Its kernel can differ from that of the function, but its
/// coordinates must be doubles.
///
/// The maps are named parameters; those that are given are filled. Maps known from CGAL use CGAL's sign: curvatures
/// of spheres are positive, opposite to Euclidean_structure_3. A vector is converted to the value type of the map if
/// that can be constructed from three numbers. Principal curvatures are written to a struct with the members of
/// CGAL's Principal_curvatures_and_directions.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_status_map` | map of Point_status | none | which numbers exist; it is read, too |
/// | `vertex_structure_map` | map of Local_structure_3 | none | the whole structure |
/// | `vertex_affine_Gaussian_curvature_map` | map of numbers | none | K |
/// | `vertex_affine_mean_curvature_map` | map of numbers | none | H |
/// | `vertex_pick_invariant_map` | map of numbers | none | J |
/// | `vertex_affine_normal_map` | map of vectors | none | xi |
/// | `vertex_conormal_map` | map of vectors | none | nu |
/// | `vertex_affine_metric_map` | map of arrays | none | xx xy xz yy yz zz of the affine metric |
/// | `vertex_affine_area_density_map` | map of numbers | none | the affine area per Euclidean area |
/// | `vertex_unit_normal_map` | map of vectors | none | n |
/// | `vertex_mean_curvature_map` | map of numbers | none | -H_e, of CGAL |
/// | `vertex_Gaussian_curvature_map` | map of numbers | none | K_e, of CGAL |
/// | `vertex_principal_curvatures_and_directions_map` | map of structs | none | k_1, k_2 with directions, of CGAL |
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
///
/// `geom_traits` and `verbose` are accepted for compatibility with CGAL, and ignored.
///
/// If no map to fill is given, a CGAL::Surface_mesh gets `v:status` (Point_status), `v:normal`, `v:conormal`,
/// `v:affine_normal`, `v:direction1`, `v:direction2` (Vector_3), and a map of FT for every other attribute in
/// doc/program.md except the norms of gradients: `v:k1`, `v:metric_xx`, `v:quadric_defect` and so on.
/// `v:vertex_area` and `v:affine_area` require faces; polygons with n corners contribute one n-th of their area to
/// each. These maps have the sign of Euclidean_structure_3: on a unit sphere with f < 0 inside, `v:mean_curvature`
/// is -1, and the value in `vertex_mean_curvature_map` is 1.
///
/// A vertex marked as UNCONVERGED before the call keeps that status, unless it is OUTSIDE. CGAL::Sequential_tag and
/// CGAL::Parallel_tag give the same numbers. Named parameters of equiaffine and of CGAL can be in one chain or
/// several:
/// \code
/// annotate(graph, traits, CGAL::parameters::vertex_point_map(points),
///          equiaffine::parameters::vertex_pick_invariant_map(map));
/// \endcode
/// Takes one expansion of order 4 per vertex.
template <class ConcurrencyTag = CGAL::Sequential_tag, Vertex_graph Graph, ImplicitFunctionTraits_3 Traits,
          internal::Parameter_chain... Parameters>
void annotate(Graph& graph, const Traits& traits, const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_annotate_parameters<Joined, internal::Vertex_point_tag>();
  const Joined parameters = internal::joined_parameters(given...);
  static_assert(check_coordinates<Point_of_vertices<Graph, Joined>>());
  const auto point_of = [map = vertex_points(graph, parameters)](const auto& v) { return get(map, v); };
  if constexpr (internal::is_surface_mesh<Graph> && !internal::has_maps<Joined>(internal::Structure_tags()))
    internal::annotate_surface_mesh<ConcurrencyTag>(graph, point_of, traits);
  else internal::annotate_elements<ConcurrencyTag>(vertices_of(graph), point_of, traits, parameters);
}

/// The same for one vertex; also returns its structure. A Surface_mesh gets no maps of its own here.
template <class Vertex, Vertex_graph Graph, ImplicitFunctionTraits_3 Traits, internal::Parameter_chain... Parameters>
Local_structure_3<typename Traits::FT> annotate(const Vertex& v, const Graph& graph, const Traits& traits,
                                                const Parameters&... given) {
  internal::check_annotate_parameters<internal::Joined_parameters<Parameters...>, internal::Vertex_point_tag>();
  const auto parameters = internal::joined_parameters(given...);
  const auto structure =
      internal::structure_at(traits, get(vertex_points(graph, parameters), v), internal::status_before(parameters, v));
  internal::put_structure(parameters, v, structure, internal::Structure_tags());
  return structure;
}

/// The same for a range, such as CGAL::Point_set_3; the keys of maps are its elements. The elements are points, or a
/// member of the range or the named parameter `point_map` (in the place of `vertex_point_map`) maps them to points.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::forward_range Points,
          ImplicitFunctionTraits_3 Traits, internal::Parameter_chain... Parameters>
void annotate(Points&& points, const Traits& traits, const Parameters&... given) requires(!Vertex_graph<Points>) {
  internal::check_annotate_parameters<internal::Joined_parameters<Parameters...>, internal::Point_tag>();
  const auto parameters = internal::joined_parameters(given...);
  internal::annotate_elements<ConcurrencyTag>(points, point_of_element(points, parameters), traits, parameters);
}

/// \cond
// Overloads for invalid calls, see function/concepts.h.
template <class ConcurrencyTag = CGAL::Sequential_tag, class Elements, class Traits, class... Others>
void annotate(const Elements&, const Traits&, const Others&...) requires(
    (Vertex_graph<Elements> || std::ranges::input_range<Elements>)&&!(ImplicitFunctionTraits_3<Traits> &&
                                                                      (internal::Parameter_chain<Others> && ...))) {
  internal::explain_traits<Traits>();
  internal::explain_parameters<Others...>();
}
template <class Vertex, class Graph, class Traits, class... Others>
void annotate(const Vertex&, const Graph&, const Traits&, const Others&...) requires(
    Vertex_graph<Graph> && !Vertex_graph<Vertex> && !std::ranges::input_range<Vertex> &&
    !(ImplicitFunctionTraits_3<Traits> && (internal::Parameter_chain<Others> && ...))) {
  internal::explain_traits<Traits>();
  internal::explain_parameters<Others...>();
}
/// \endcond

} // namespace equiaffine

#endif
