// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FIT_DATA_OF_H
#define EQUIAFFINE_FIT_INTERNAL_FIT_DATA_OF_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/internal/Fit_data_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>
#include <equiaffine/mesh/internal/points_of_range.h>

#include <CGAL/property_map.h>

#include <optional>
#include <ranges>
#include <type_traits>
#include <utility>

namespace equiaffine::internal {

/// The angle in degrees of creases, over which fits do not reach and which a remesh keeps; nothing for no creases.
template <class Parameters>
std::optional<double> feature_angle(const Parameters& parameters) {
  const auto angle = get_parameter<Feature_angle_tag>(parameters, std::optional<double>(60.));
  check_argument(!angle || (*angle >= 0 && *angle <= 180), "the angle of creases is from 0 to 180 degrees");
  return angle;
}

// Meshes and points of CGAL become arrays.

/// The points are the vertices in their order.
template <Face_graph Graph, class Parameters>
Fit_data_3 fit_data_of_graph(const Graph& graph, const Parameters& parameters) {
  check_coordinates<Point_of_vertices<const Graph, Parameters>>();
  Indexed_polygons mesh = indexed_polygons_of_graph(graph, parameters);
  Fit_data_3 data = {Fit_data_3::Kind::MESH, std::move(mesh.points), std::move(mesh.polygons)};
  data.feature_angle = feature_angle(parameters);
  if constexpr (has_parameter<Vertex_normal_tag, Parameters>)
    for (const auto v : vertices_of(graph))
      data.normals.push_back(coordinates_of(get(given_parameter<Vertex_normal_tag>(parameters), v)));
  return data;
}

template <std::ranges::input_range Points, class Parameters>
Fit_data_3 fit_data_of_points(Points&& range, const Parameters& parameters) {
  Fit_data_3 data = {Fit_data_3::Kind::POINTS};
  const auto point_of = point_of_element(range, parameters);
  check_coordinates<std::decay_t<decltype(point_of(*std::ranges::begin(range)))>>();
  for (const auto& element : range) {
    data.points.push_back(coordinates_of(point_of(element)));
    if constexpr (has_parameter<Normal_tag, Parameters>)
      data.normals.push_back(coordinates_of(get(given_parameter<Normal_tag>(parameters), element)));
  }
  check_points(data.points);
  data.orientation = get_parameter<Normal_orientation_tag>(parameters, Normal_orientation::ORIENTED);
  return data;
}

template <std::ranges::input_range Points, std::ranges::input_range Polygons, class Parameters>
Fit_data_3 fit_data_of_soup(const Points& points, const Polygons& polygons, const Parameters& parameters) {
  Fit_data_3 data = {Fit_data_3::Kind::SOUP};
  data.feature_angle = feature_angle(parameters);
  Indexed_polygons soup = indexed_polygons_of_soup(points, polygons);
  data.points = std::move(soup.points);
  data.polygons = std::move(soup.polygons);
  return data;
}

} // namespace equiaffine::internal

#endif
