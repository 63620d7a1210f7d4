// SPDX-License-Identifier: GPL-3.0-or-later
// Converts meshes, polygon soups and points of CGAL to arrays of numbers.
#ifndef EQUIAFFINE_MESH_INTERNAL_INDEXED_POLYGONS_H
#define EQUIAFFINE_MESH_INTERNAL_INDEXED_POLYGONS_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/named_parameters.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <ranges>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace equiaffine {

/// Fails to compile for points whose coordinates are not floating-point numbers; otherwise returns true, so that a
/// static assertion can call it before anything else fails.
template <class Point>
constexpr bool check_coordinates() {
  static_assert(
      std::is_floating_point_v<std::decay_t<decltype(std::declval<const Point&>().x())>>,
      "the points have exact coordinates, like those of Epeck: use a kernel with floating-point coordinates, such as "
      "Epick or Simple_cartesian<double>; CGAL::copy_face_graph converts a mesh");
  return true;
}

/// Returns a function from the elements of a range to their points: the given property map, or that of the range
/// (CGAL::Point_set_3 has one), or the identity if the elements are points.
template <class Range, class Parameters>
auto point_of_element([[maybe_unused]] const Range& range, const Parameters& parameters) {
  if constexpr (internal::has_parameter<internal::Point_tag, Parameters>)
    return [map = internal::given_parameter<internal::Point_tag>(parameters)](const auto& element) {
      return get(map, element);
    };
  else if constexpr (requires { range.point_map(); })
    return [map = range.point_map()](const auto& element) { return get(map, element); };
  else return [](const auto& element) { return element; };
}

template <class Vector>
Eigen::Vector3d coordinates_of(const Vector& v) {
  return {CGAL::to_double(v.x()), CGAL::to_double(v.y()), CGAL::to_double(v.z())};
}

/// Points, and polygons as indices of points.
struct Indexed_polygons {
  std::vector<Eigen::Vector3d> points = {};
  std::vector<std::vector<std::uint32_t>> polygons = {};
};

/// Twice the vector area of a polygon, the sum over a fan of triangles.
template <class Polygon>
Eigen::Vector3d double_area_of_polygon(const std::vector<Eigen::Vector3d>& points, const Polygon& polygon) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    sum += (points[polygon[k]] - points[polygon[0]]).cross(points[polygon[k + 1]] - points[polygon[0]]);
  return sum;
}

inline void check_points(const std::vector<Eigen::Vector3d>& points) {
  check_argument(points.size() < std::numeric_limits<std::uint32_t>::max(),
                 "the surface has too many points: pass fewer than 2^32 points");
  check_argument(std::all_of(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); }),
                 "a point has a coordinate that is not finite: remove the point");
}

template <class Graph, class Parameters>
auto vertex_points(Graph& graph, const Parameters& parameters) {
  if constexpr (internal::has_parameter<internal::Vertex_point_tag, Parameters>)
    return internal::given_parameter<internal::Vertex_point_tag>(parameters);
  else return get(CGAL::vertex_point, graph);
}

/// The type of the points in this map.
template <class Graph, class Parameters>
using Point_of_vertices = typename boost::property_traits<
    std::decay_t<decltype(vertex_points(std::declval<Graph&>(), std::declval<const Parameters&>()))>>::value_type;

/// The points of the result are those of the vertices, in their order.
template <Face_graph Graph, class Parameters>
Indexed_polygons indexed_polygons_of_graph(const Graph& graph, const Parameters& parameters) {
  using Vertex = typename boost::graph_traits<Graph>::vertex_descriptor;
  const auto point_of = vertex_points(graph, parameters);
  Indexed_polygons result;
  std::unordered_map<Vertex, std::uint32_t> index;
  for (const Vertex v : vertices_of(graph)) {
    index.emplace(v, std::uint32_t(result.points.size()));
    result.points.push_back(coordinates_of(get(point_of, v)));
  }
  check_points(result.points);
  for (const auto f : faces_of(graph)) {
    auto& polygon = result.polygons.emplace_back();
    for (const Vertex v : CGAL::vertices_around_face(halfedge(f, graph), graph)) polygon.push_back(index.at(v));
  }
  return result;
}

template <std::ranges::input_range Points, std::ranges::input_range Polygons>
Indexed_polygons indexed_polygons_of_soup(const Points& points, const Polygons& polygons) {
  Indexed_polygons result;
  for (const auto& p : points) result.points.push_back(coordinates_of(p));
  check_points(result.points);
  for (const auto& polygon : polygons) {
    auto& positions = result.polygons.emplace_back();
    for (const auto i : polygon) {
      check_argument(std::size_t(i) < result.points.size(),
                     "a polygon has an index that is not below the number of points: pass all points");
      positions.push_back(std::uint32_t(i));
    }
  }
  return result;
}

/// Returns for each point the index of the first point equal to it.
inline std::vector<std::uint32_t> first_of_equal(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::uint32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](std::uint32_t i) { return std::array<double, 3>{points[i][0], points[i][1], points[i][2]}; };
  std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return key(i) < key(j); });
  for (std::size_t k = 0; k < order.size(); ++k)
    first[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? first[order[k - 1]] : order[k];
  return first;
}

} // namespace equiaffine

namespace equiaffine::internal {

/// A triangle mesh with double coordinates.
struct Triangles_3 {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  const Eigen::Vector3d& corner(std::size_t t, std::size_t k) const { return points[triangles[t][k % 3]]; }
  Eigen::Vector3d double_area(std::size_t t) const {
    return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
  }
};

inline Triangles_3 triangles_of(Indexed_polygons mesh) {
  Triangles_3 result;
  for (const auto& polygon : mesh.polygons) add_triangles_of_polygon(mesh.points, polygon, result.triangles);
  result.points = std::move(mesh.points);
  return result;
}

template <class Graph, class Parameters>
Triangles_3 triangles_of_graph(const Graph& graph, const Parameters& parameters) {
  return triangles_of(indexed_polygons_of_graph(graph, parameters));
}

/// Merges equal points, so that triangles are connected at common corners.
template <class Points, class Polygons>
Triangles_3 triangles_of_soup(const Points& points, const Polygons& polygons) {
  Triangles_3 mesh = triangles_of(indexed_polygons_of_soup(points, polygons));
  const std::vector<std::uint32_t> first = first_of_equal(mesh.points);
  for (auto& triangle : mesh.triangles)
    for (auto& corner : triangle) corner = first[corner];
  return mesh;
}

/// The vertices of a graph, in their order, and its faces, triangulated.
template <class Kernel, class Graph, class Parameters>
Indexed_triangle_mesh_3<Kernel> triangle_mesh_of(const Graph& graph, const Parameters& parameters) {
  const Indexed_polygons mesh = indexed_polygons_of_graph(graph, parameters);
  Indexed_triangle_mesh_3<Kernel> result;
  for (const auto& p : mesh.points) result.points.emplace_back(p.x(), p.y(), p.z());
  for (const auto& polygon : mesh.polygons) add_triangles_of_polygon(mesh.points, polygon, result.triangles);
  return result;
}

} // namespace equiaffine::internal

#endif
