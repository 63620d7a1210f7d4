// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_DATA_FIT_INPUT_H
#define EQUIAFFINE_FIT_INTERNAL_DATA_FIT_INPUT_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Normal_orientation.h>
#include <equiaffine/fit/internal/data/data_of_mesh.h>
#include <equiaffine/fit/internal/data/data_of_points.h>
#include <equiaffine/fit/internal/data/feature_angle.h>
#include <equiaffine/surface/internal/shared/Face_graph.h>
#include <equiaffine/surface/internal/shared/indexed_polygons.h>
#include <equiaffine/surface/internal/shared/points_of_range.h>

#include <CGAL/property_map.h>
#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <ranges>
#include <type_traits>
#include <utility>
#include <vector>

// Meshes and points of CGAL become arrays of data points.
namespace equiaffine::internal {

/// The data points are the vertices in their order, and behind them others at creases.
template <Face_graph Graph, class Parameters>
Normalized_data fit_input_of_graph(const Graph& graph, const Parameters& parameters) {
  check_coordinates<Point_of_vertices<const Graph, Parameters>>();
  const Indexed_polygons mesh = indexed_polygons_of_graph(graph, parameters);
  Normalized_data result = data_of_mesh(mesh.points, mesh.polygons, feature_angle(parameters));
  if constexpr (has_parameter<Vertex_normal_tag, Parameters>) {
    std::vector<Eigen::Vector3d> normals;
    for (const auto v : vertices_of(graph))
      normals.push_back(coordinates_of(get(given_parameter<Vertex_normal_tag>(parameters), v)));
    improve_normals(result, normals);
  }
  return result;
}

/// The data points of a range without those that come again, and which of them each element of the range is.
struct Fit_input_of_points {
  Normalized_data data;
  std::vector<std::uint32_t> positions;
};

/// Equal points become one: returns which one each point is, and keeps the first of each kind in `points`.
inline std::vector<std::uint32_t> merge_equal_points(std::vector<Eigen::Vector3d>& points,
                                                     std::vector<Eigen::Vector3d>& normals) {
  const std::vector<std::uint32_t> first = first_of_equal(points);
  std::vector<std::uint32_t> positions(points.size());
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (first[i] != i) {
      positions[i] = positions[first[i]];
      continue;
    }
    points[kept] = points[i];
    if (!normals.empty()) normals[kept] = normals[i];
    positions[i] = kept++;
  }
  points.resize(kept);
  if (!normals.empty()) normals.resize(kept);
  return positions;
}

template <class ConcurrencyTag, std::ranges::input_range Points, class Parameters>
Fit_input_of_points fit_input_of_points(Points&& range, const Parameters& parameters) {
  std::vector<Eigen::Vector3d> points, normals;
  const auto point_of = point_of_element(range, parameters);
  check_coordinates<std::decay_t<decltype(point_of(*std::ranges::begin(range)))>>();
  for (const auto& element : range) {
    points.push_back(coordinates_of(point_of(element)));
    if constexpr (has_parameter<Normal_tag, Parameters>)
      normals.push_back(coordinates_of(get(given_parameter<Normal_tag>(parameters), element)));
  }
  check_points(points);
  Fit_input_of_points result;
  result.positions = merge_equal_points(points, normals);
  const auto orientation = get_parameter<Normal_orientation_tag>(parameters, Normal_orientation::ORIENTED);
  result.data = data_of_points<ConcurrencyTag>(points, normals, orientation);
  return result;
}

} // namespace equiaffine::internal

#endif
