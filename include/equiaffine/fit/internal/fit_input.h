// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FIT_INPUT_H
#define EQUIAFFINE_FIT_INTERNAL_FIT_INPUT_H

#include <equiaffine/base/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/fit/Normal_orientation.h>
#include <equiaffine/fit/internal/data_of_mesh.h>
#include <equiaffine/fit/internal/data_of_points.h>
#include <equiaffine/surface/Face_graph.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <ranges>
#include <unordered_map>
#include <utility>
#include <vector>

// Meshes and points of CGAL become arrays of data points.
namespace equiaffine::internal {

template <class Vector>
Eigen::Vector3d coordinates_of(const Vector& v) {
  return {CGAL::to_double(v.x()), CGAL::to_double(v.y()), CGAL::to_double(v.z())};
}

inline void check_points(const std::vector<Eigen::Vector3d>& points) {
  check_argument(points.size() < std::numeric_limits<std::uint32_t>::max(), "a fit takes fewer than 2^32 points");
  check_argument(std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }),
                 "a point has a coordinate that is not a finite number: remove it");
}

template <class Graph, class Parameters>
auto vertex_points(const Graph& graph, const Parameters& parameters) {
  if constexpr (has_parameter<Vertex_point_tag, Parameters>) return given_parameter<Vertex_point_tag>(parameters);
  else return get(CGAL::vertex_point, graph);
}

/// The data points are the vertices in their order.
template <Face_graph Graph, class Parameters>
Normalized_data fit_input_of_graph(const Graph& graph, const Parameters& parameters) {
  using Vertex = typename boost::graph_traits<Graph>::vertex_descriptor;
  const auto point_of = vertex_points(graph, parameters);
  std::vector<Eigen::Vector3d> points;
  std::unordered_map<Vertex, std::uint32_t> index;
  for (const Vertex v : vertices(graph)) {
    index.emplace(v, std::uint32_t(points.size()));
    points.push_back(coordinates_of(get(point_of, v)));
  }
  check_points(points);
  std::vector<std::vector<std::uint32_t>> polygons;
  for (const auto f : faces(graph)) {
    auto& polygon = polygons.emplace_back();
    for (const Vertex v : CGAL::vertices_around_face(halfedge(f, graph), graph)) polygon.push_back(index.at(v));
  }
  return data_of_mesh(points, polygons);
}

/// The data points of a range without those that come again, and which of them each element of the range is.
struct Fit_input_of_points {
  Normalized_data data;
  std::vector<std::uint32_t> positions;
};

/// Equal points become one: returns which one each point is, and keeps the first of each kind in `points`.
inline std::vector<std::uint32_t> merge_equal_points(std::vector<Eigen::Vector3d>& points,
                                                     std::vector<Eigen::Vector3d>& normals) {
  std::vector<std::uint32_t> order(points.size()), positions(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::uint32_t i) { return std::array<double, 3>{points[i][0], points[i][1], points[i][2]}; };
  std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return key(i) < key(j); });
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? first[order[k - 1]] : order[k];
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
Fit_input_of_points fit_input_of_points(const Points& range, const Parameters& parameters) {
  std::vector<Eigen::Vector3d> points, normals;
  for (const auto& element : range) {
    if constexpr (has_parameter<Point_tag, Parameters>)
      points.push_back(coordinates_of(get(given_parameter<Point_tag>(parameters), element)));
    else points.push_back(coordinates_of(element));
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
