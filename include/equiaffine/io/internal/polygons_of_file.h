// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_POLYGONS_OF_FILE_H
#define EQUIAFFINE_IO_INTERNAL_POLYGONS_OF_FILE_H

#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace equiaffine::internal {

/// The points of a file with their numbers, and its polygons, not cut into triangles.
struct Polygons_of_file {
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points = {};
  std::vector<std::vector<std::uint32_t>> polygons = {};
  Vertex_attributes attributes = {};
};

// The library defines this function.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Reads PLY or OFF, as the extension says.
Polygons_of_file polygons_of_file(const std::string& path);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

/// Adds the points and polygons to a mesh, and returns its new vertices in the order of the points.
template <class Graph, class Point_map>
auto add_polygons(Graph& graph, const Point_map& point_map, const Polygons_of_file& file, const std::string& path) {
  using Point = typename boost::property_traits<Point_map>::value_type;
  using Vertex = typename boost::graph_traits<Graph>::vertex_descriptor;
  std::vector<Vertex> added;
  added.reserve(file.points.size());
  for (const auto& p : file.points) {
    added.push_back(add_vertex(graph));
    put(point_map, added.back(), Point(p.x(), p.y(), p.z()));
  }
  std::vector<Vertex> corners;
  std::vector<std::uint32_t> sorted;
  for (std::size_t f = 0; f < file.polygons.size(); ++f) {
    corners.clear();
    for (const std::uint32_t v : file.polygons[f]) corners.push_back(added[v]);
    sorted = file.polygons[f];
    std::sort(sorted.begin(), sorted.end());
    if (corners.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      fail_to_read(path, "its face " + std::to_string(f) + " has fewer than three corners, or one of them twice",
                   "remove it, or use read_points(), which gives points and triangles");
    if (CGAL::Euler::add_face(corners, graph) == boost::graph_traits<Graph>::null_face())
      fail_to_read(path, "its face " + std::to_string(f) + " cannot be added, since the faces are not a manifold there",
                   "orient_polygon_soup() of CGAL mends that, and read_points() gives points and triangles");
  }
  return added;
}

} // namespace equiaffine::internal

#endif
