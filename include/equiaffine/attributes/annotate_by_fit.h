// SPDX-License-Identifier: GPL-3.0-or-later
// Writes local structures, and their estimated errors, from fits to a mesh or to points to property maps.
#ifndef EQUIAFFINE_ATTRIBUTES_ANNOTATE_BY_FIT_H
#define EQUIAFFINE_ATTRIBUTES_ANNOTATE_BY_FIT_H

#include <equiaffine/attributes/Fit_statistics.h>
#include <equiaffine/attributes/internal/maps_of_columns.h>
#include <equiaffine/attributes/internal/vertex_maps.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Fit_options.h>
#include <equiaffine/fit/fitted_structures.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <CGAL/boost/graph/graph_traits_Surface_mesh.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <concepts>
#include <cstddef>
#include <ranges>
#include <vector>

namespace equiaffine::internal {

template <class Parameters, class... OtherTags, class... Tags, class... More>
constexpr void check_maps_of_fit(Tag_list<Tags...>, Tag_list<More...>) {
  check_fit_parameters<Parameters, OtherTags..., Tags..., More...>();
}

template <class Parameters, class... OtherTags>
constexpr void check_annotate_by_fit_parameters() {
  check_maps_of_fit<Parameters, OtherTags...>(Structure_tags(), Error_tags());
}

template <class Parameters>
inline constexpr bool has_maps_of_fit = has_maps<Parameters>(Structure_tags()) || has_maps<Parameters>(Error_tags());

template <class Parameters, class Key>
void put_structure_of_fit(const Parameters& parameters, Key& key, const Fitted_structure_3<double>& structure) {
  put_structure(parameters, key, structure, Structure_tags());
  put_structure(parameters, key, structure, Error_tags());
}

/// Fills the given maps with the structures of the elements, in their order.
template <class Parameters, class Elements>
void put_structures_of_fit(const Parameters& parameters, Elements&& elements,
                           const std::vector<Fitted_structure_3<double>>& structures) {
  static_assert(has_maps_of_fit<Parameters>,
                "annotate_by_fit() has nothing to write to: give it property maps, such as "
                "parameters::vertex_affine_mean_curvature_map(map), or a CGAL::Surface_mesh that is not const");
  std::size_t i = 0;
  for (auto&& element : elements) put_structure_of_fit(parameters, element, structures[i++]);
}

/// Fills the maps `v:NAME` of a surface mesh with all attributes of its vertices.
template <class Mesh, class Parameters>
void fill_maps_of_fit(Mesh& mesh, const Parameters& parameters,
                      const std::vector<Fitted_structure_3<double>>& structures) {
  check_mesh_for_maps<Mesh>();
  std::vector<typename Mesh::Point> points;
  const auto point_map = vertex_points(mesh, parameters);
  for (const auto v : mesh.vertices()) points.push_back(get(point_map, v));
  const auto areas = areas_of_surface_mesh(mesh, points);
  add_named_maps(mesh, mesh.vertices(), attributes_of_fit(structures, selection_of_named_maps(!areas.empty()), areas));
  for (const Estimate_attribute& estimate : estimate_attributes())
    add_named_maps(mesh, mesh.vertices(), {{estimate.column(structures)}, std::nullopt});
}

} // namespace equiaffine::internal

namespace equiaffine {

/// Writes the local structure of the surface sampled by the vertices of a mesh, see `fitted_structures`, and its
/// estimated errors to property maps. The maps are named parameters, as in annotate(). `vertex_structure_map` takes
/// a Fitted_structure_3<double>; no map is read. AGAINST_GRADIENT flips the normals.
///
/// The named parameters are those of fitted_structures(), the maps of annotate(), and maps of the estimated errors:
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_affine_Gaussian_curvature_error_map` | map of numbers | none | of K |
/// | `vertex_affine_mean_curvature_error_map` | map of numbers | none | of H |
/// | `vertex_pick_invariant_error_map` | map of numbers | none | of J |
/// | `vertex_affine_normal_error_map` | map of numbers | none | of xi, in degrees |
/// | `vertex_conormal_error_map` | map of numbers | none | of nu, in degrees |
/// | `vertex_affine_area_density_error_map` | map of numbers | none | of the affine area density |
/// | `vertex_mean_curvature_error_map` | map of numbers | none | of H_e |
/// | `vertex_Gaussian_curvature_error_map` | map of numbers | none | of K_e |
/// | `vertex_unit_normal_error_map` | map of numbers | none | of n, in degrees |
///
/// If no map to fill is given, a CGAL::Surface_mesh gets the maps of annotate(), and one for each estimate listed in
/// doc/program.md: `v:NAME_error`, and `v:NAME_noise` and `v:NAME_detail` for the affine curvatures.
///
/// Named parameters of equiaffine and of CGAL can be in one chain or several.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Graph, internal::Parameter_chain... Parameters>
void annotate_by_fit(Graph& mesh, const Fit_options& options, Orientation_of_level_set orientation,
                     const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_annotate_by_fit_parameters<Joined, internal::Vertex_point_tag, internal::Vertex_normal_tag>();
  const Joined parameters = internal::joined_parameters(given...);
  const auto structures = internal::fitted_structures_of_graph<ConcurrencyTag>(mesh, options, orientation, parameters);
  if constexpr (internal::is_surface_mesh<Graph> && !internal::has_maps_of_fit<Joined>)
    internal::fill_maps_of_fit(mesh, parameters, structures);
  else internal::put_structures_of_fit(parameters, vertices_of(mesh), structures);
}
/// The same with normals on the side of the mesh.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Graph, internal::Parameter_chain... Parameters>
void annotate_by_fit(Graph& mesh, const Fit_options& options = {}, const Parameters&... given) {
  annotate_by_fit<ConcurrencyTag>(mesh, options, Orientation_of_level_set::ALONG_GRADIENT, given...);
}

/// The same for one vertex; also returns its structure, see fitted_structure(). A Surface_mesh gets no maps of its
/// own here.
template <class Vertex, Face_graph Graph, internal::Parameter_chain... Parameters>
Fitted_structure_3<double> annotate_by_fit(const Vertex& v, const Graph& mesh, const Fit_options& options,
                                           Orientation_of_level_set orientation, const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_annotate_by_fit_parameters<Joined, internal::Vertex_point_tag, internal::Vertex_normal_tag>();
  const Joined parameters = internal::joined_parameters(given...);
  const auto structure = internal::fitted_structure_of_vertex(v, mesh, options, orientation, parameters);
  internal::put_structure_of_fit(parameters, v, structure);
  return structure;
}
/// The same with normals on the side of the mesh.
template <class Vertex, Face_graph Graph, internal::Parameter_chain... Parameters>
Fitted_structure_3<double> annotate_by_fit(const Vertex& v, const Graph& mesh, const Fit_options& options = {},
                                           const Parameters&... given) {
  return annotate_by_fit(v, mesh, options, Orientation_of_level_set::ALONG_GRADIENT, given...);
}

/// The same for points without faces, the elements of a range, see `fitted_structures`.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::forward_range Points,
          internal::Parameter_chain... Parameters>
void annotate_by_fit(Points&& points, const Fit_options& options, Orientation_of_level_set orientation,
                     const Parameters&... given) requires(!Face_graph<Points>) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_annotate_by_fit_parameters<Joined, internal::Point_tag, internal::Normal_tag>();
  const Joined parameters = internal::joined_parameters(given...);
  internal::put_structures_of_fit(
      parameters, points,
      internal::fitted_structures_of_points<ConcurrencyTag>(points, options, orientation, parameters));
}
/// The same with normals on the side of the given ones.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::forward_range Points,
          internal::Parameter_chain... Parameters>
void annotate_by_fit(Points&& points, const Fit_options& options = {},
                     const Parameters&... given) requires(!Face_graph<Points>) {
  annotate_by_fit<ConcurrencyTag>(points, options, Orientation_of_level_set::ALONG_GRADIENT, given...);
}

/// The same with `map` as `vertex_structure_map`.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Graph, internal::Property_map Structure_map,
          internal::Parameter_chain... Parameters>
void annotate_by_fit(const Graph& mesh, Structure_map map, const Fit_options& options = {},
                     const Parameters&... given) {
  annotate_by_fit<ConcurrencyTag>(mesh, options, parameters::vertex_structure_map(map), given...);
}
/// The same for points without faces.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::forward_range Points,
          internal::Property_map Structure_map, internal::Parameter_chain... Parameters>
void annotate_by_fit(Points&& points, Structure_map map, const Fit_options& options = {},
                     const Parameters&... given) requires(!Face_graph<Points>) {
  annotate_by_fit<ConcurrencyTag>(points, options, parameters::vertex_structure_map(map), given...);
}

/// \cond
// Overload for invalid calls, see base/named_parameters.h.
template <class ConcurrencyTag = CGAL::Sequential_tag, class Elements, class First, class... Others>
void annotate_by_fit(const Elements&, const First&, const Others&...) requires(
    (Face_graph<Elements> || std::ranges::input_range<Elements>)&&!(std::convertible_to<First, Fit_options> ||
                                                                    internal::Property_map<First>)) {
  internal::explain_options<First>();
}
/// \endcond

} // namespace equiaffine

#endif
