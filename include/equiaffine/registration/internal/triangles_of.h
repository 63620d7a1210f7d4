// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_TRIANGLES_OF_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_TRIANGLES_OF_H

#include <equiaffine/base/check_argument.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/registration/internal/mesh_samples.h>
#include <equiaffine/registration/internal/vectors_of.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <Eigen/Core>
#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace equiaffine::internal {

/// Makes triangles of polygons whose corners are added one by one.
class Triangles_builder {
public:
  explicit Triangles_builder(std::vector<Eigen::Vector3d> points) {
    check_argument(points.size() < std::numeric_limits<std::uint32_t>::max(), "a mesh has fewer than 2^32 points");
    check_argument(std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }),
                   "a point has a coordinate that is not a finite number: remove it");
    mesh_.points = std::move(points);
  }

  void begin_polygon() { corners_ = 0; }

  /// Adds the triangle of the polygon's first corner, its last one and this one.
  void add_corner(std::size_t point) {
    check_argument(point < mesh_.points.size(), "a polygon has the position of no point: give all points");
    const auto corner = std::uint32_t(point);
    if (corners_ == 0) first_ = corner;
    if (corners_ >= 2) mesh_.triangles.push_back({first_, last_, corner});
    last_ = corner;
    ++corners_;
  }

  Triangles_3 result() && { return std::move(mesh_); }

private:
  Triangles_3 mesh_;
  std::size_t corners_ = 0;
  std::uint32_t first_ = 0, last_ = 0;
};

template <class Graph, class Parameters>
auto vertex_points_of(const Graph& graph, const Parameters& parameters) {
  if constexpr (has_parameter<Vertex_point_tag, Parameters>) return given_parameter<Vertex_point_tag>(parameters);
  else return get(CGAL::vertex_point, graph);
}

template <class Graph, class Parameters>
Triangles_3 triangles_of_graph(const Graph& graph, const Parameters& parameters) {
  using Vertex = typename boost::graph_traits<Graph>::vertex_descriptor;
  const auto point_of = vertex_points_of(graph, parameters);
  std::vector<typename boost::property_traits<std::remove_const_t<decltype(point_of)>>::value_type> points;
  std::unordered_map<Vertex, std::size_t> index;
  for (const Vertex v : vertices(graph)) {
    index.emplace(v, points.size());
    points.push_back(get(point_of, v));
  }
  Triangles_builder builder(vectors_of(points));
  for (const auto f : faces(graph)) {
    builder.begin_polygon();
    for (const Vertex v : CGAL::vertices_around_face(halfedge(f, graph), graph)) builder.add_corner(index.at(v));
  }
  return std::move(builder).result();
}

/// Returns the first of the points that are equal to each one: triangles that share a corner are to know it.
inline std::vector<std::size_t> first_equal_points(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::size_t> order(points.size()), first(points.size());
  const auto key = [&](std::size_t i) { return std::array<double, 3>{points[i][0], points[i][1], points[i][2]}; };
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? first[order[k - 1]] : order[k];
  return first;
}

template <class Points, class Polygons>
Triangles_3 triangles_of_soup(const Points& points, const Polygons& polygons) {
  Triangles_builder builder(vectors_of(points));
  for (const auto& polygon : polygons) {
    builder.begin_polygon();
    for (const auto i : polygon) builder.add_corner(std::size_t(i));
  }
  Triangles_3 mesh = std::move(builder).result();
  const auto first = first_equal_points(mesh.points);
  for (auto& triangle : mesh.triangles)
    for (auto& corner : triangle) corner = std::uint32_t(first[corner]);
  return mesh;
}

} // namespace equiaffine::internal

#endif
