// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_ANNOTATE_BY_FIT_H
#define EQUIAFFINE_ANNOTATE_BY_FIT_H

#include <equiaffine/attributes/internal/Property_maps.h>
#include <equiaffine/attributes/internal/shared/error_table.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fitted_structures.h>
#include <equiaffine/surface/internal/shared/Face_graph.h>

#include <CGAL/Surface_mesh.h>
#include <CGAL/property_map.h>
#include <CGAL/tags.h>

#include <cstddef>
#include <ranges>
#include <string>
#include <vector>

namespace equiaffine {

/// Fills property maps of the vertices of `mesh` with the local structure of the surface that the vertices are samples
/// of, as `fitted_structures` finds it: the maps that `annotate` with a function fills, the estimates `v:NAME_error` of
/// the errors of all NAMEs in error_table.h, and `v:affine_gaussian_curvature_noise` and
/// `v:affine_mean_curvature_noise`. Named parameters: `noise`, `scale`, `degree`, `orientation`.
template <class ConcurrencyTag = CGAL::Sequential_tag, class Point, class Parameters = internal::No_parameters>
void annotate_by_fit(CGAL::Surface_mesh<Point>& mesh, const Parameters& parameters = {}) {
  internal::check_fit_parameters<Parameters, internal::Orientation_tag>();
  using Mesh = CGAL::Surface_mesh<Point>;
  using Maps = internal::Property_maps<Mesh>;
  const std::vector<Fitted_structure_3<double>> structures = fitted_structures<ConcurrencyTag>(mesh, parameters);
  Maps maps(mesh);
  std::vector<typename Mesh::template Property_map<typename Mesh::Vertex_index, double>> errors;
  for (const auto& row : error_table<double>)
    errors.push_back(Maps::template add<double>(mesh, std::string(row.attribute) + "_error"));
  auto gaussian_noise = Maps::template add<double>(mesh, "affine_gaussian_curvature_noise");
  auto mean_noise = Maps::template add<double>(mesh, "affine_mean_curvature_noise");
  std::size_t i = 0;
  for (const auto v : mesh.vertices()) {
    const auto& s = structures[i++];
    maps.set(v, s.structure);
    for (std::size_t n = 0; n < errors.size(); ++n) errors[n][v] = error_table<double>[n].get(s.error);
    gaussian_noise[v] = s.noise.gaussian_curvature;
    mean_noise[v] = s.noise.mean_curvature;
  }
}

/// Puts the `Fitted_structure_3<double>` of every vertex of any model of CGAL's FaceGraph into a property map.
template <class ConcurrencyTag = CGAL::Sequential_tag, Face_graph Graph, class Structure_map,
          class Parameters = internal::No_parameters>
void annotate_by_fit(const Graph& mesh, Structure_map map, const Parameters& parameters = {}) requires requires {
  typename boost::property_traits<Structure_map>::key_type;
}
{
  internal::check_fit_parameters<Parameters, internal::Vertex_point_tag, internal::Orientation_tag>();
  const auto structures = fitted_structures<ConcurrencyTag>(mesh, parameters);
  std::size_t i = 0;
  for (const auto v : vertices(mesh)) put(map, v, structures[i++]);
}

/// Puts the `Fitted_structure_3<double>` of every element of a range of points into a property map.
template <class ConcurrencyTag = CGAL::Sequential_tag, std::ranges::input_range Points, class Structure_map,
          class Parameters = internal::No_parameters>
    void annotate_by_fit(const Points& points, Structure_map map,
                         const Parameters& parameters = {}) requires(!Face_graph<Points>) &&
    requires {
  typename boost::property_traits<Structure_map>::key_type;
}
{
  internal::check_point_fit_parameters<Parameters, internal::Orientation_tag>();
  const auto structures = fitted_structures<ConcurrencyTag>(points, parameters);
  std::size_t i = 0;
  for (const auto& element : points) put(map, element, structures[i++]);
}

} // namespace equiaffine

#endif
