// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes meshes of CGAL, with the attributes of their vertices as property maps.
#ifndef EQUIAFFINE_IO_POLYGON_MESH_FILES_H
#define EQUIAFFINE_IO_POLYGON_MESH_FILES_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/io/internal/columns_of_maps.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/write_mesh.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/Face_graph.h>
#include <equiaffine/mesh/internal/indexed_polygons.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/properties.h>
#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace equiaffine::internal {

/// The points of a file with their attributes, and its polygons without triangulation.
struct Polygons_of_file {
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points = {};
  std::vector<std::vector<std::uint32_t>> polygons = {};
  Vertex_attributes attributes = {};
};

// This function is compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Reads PLY, OFF, OBJ, or STL, depending on the extension.
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
      fail_to_read(path, "its face " + std::to_string(f) + " has fewer than three corners, or a repeated one",
                   "remove it, or use read_points(), which returns points and triangles");
    if (CGAL::Euler::add_face(corners, graph) == boost::graph_traits<Graph>::null_face())
      fail_to_read(path, "its faces are not a manifold at face " + std::to_string(f),
                   "repair them with orient_polygon_soup() of CGAL, or use read_points(), which returns points and "
                   "triangles");
  }
  return added;
}

} // namespace equiaffine::internal

namespace equiaffine::IO {

/// Adds the mesh in a `.ply`, `.off`, `.obj`, or `.stl` file to a model of CGAL's MutableFaceGraph, with the
/// attributes of its vertices, and returns the comments of the file. The names and the arguments are those of
/// CGAL::IO::read_polygon_mesh(), which supports more formats but ignores most attributes; errors are exceptions
/// here. Polygons are not triangulated.
///
/// A CGAL::Surface_mesh gets named maps: `v:NAME` of double for each column NAME, `v:NAME` of Vector_3 for three
/// columns NAME_x, NAME_y, NAME_z, `v:normal` for nx, ny, nz, and `v:status` of Point_status. These are the maps that
/// annotate() had added to the mesh that was written. For any mesh you can have your own maps filled instead, with
/// the named parameters of annotate() and annotate_by_fit() except `vertex_structure_map`, and with CGAL's sign where
/// the names are those of CGAL.
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | writable property map | the mesh's own | from vertices to points |
/// | `vertex_status_map` and so on | writable property maps | none | see annotate() and annotate_by_fit() |
///
/// `geom_traits` and `verbose` are accepted for compatibility with CGAL and ignored.
///
/// \throw Input_error if the file cannot be read, its faces are not a manifold, or it has no numbers for a map; the
/// mesh may then contain a part of the file
template <Face_graph Graph, internal::Parameter_chain... Parameters>
std::vector<std::string> read_polygon_mesh(const std::string& path, Graph& mesh, const Parameters&... given) {
  using Joined = internal::Joined_parameters<Parameters...>;
  internal::check_map_file_parameters<Joined, internal::Vertex_point_tag>();
  static_assert(!std::is_const_v<Graph>, "the mesh to read into is const: give one that can be modified");
  static_assert(check_coordinates<Point_of_vertices<Graph, Joined>>());
  const Joined parameters = internal::joined_parameters(given...);
  auto file = internal::polygons_of_file(path);
  const auto added = internal::add_polygons(mesh, vertex_points(mesh, parameters), file, path);
  const auto comments = file.attributes.comments;
  internal::fill_maps(mesh, added, parameters, std::move(file.attributes), path);
  return comments;
}

/// Writes a mesh with the attributes of its vertices. The extension determines the format: `.ply` and `.csv` hold all
/// attributes, `.obj` the normals, `.off` and `.stl` none; `.csv` has no faces, and in `.stl` polygons are
/// triangulated. The file is written completely or not at all. The name and the arguments are those of
/// CGAL::IO::write_polygon_mesh(), whose parameters for precision and encoding are not needed: every double is
/// preserved.
///
/// For a CGAL::Surface_mesh without given maps, writes its maps whose values are numbers or Vector_3, under their
/// names without `v:` and with `_` for blanks, commas, and quotes, and `v:status`. Give maps by named parameters as
/// in read_polygon_mesh().
///
/// | named parameter | type | default | meaning |
/// |---|---|---|---|
/// | `vertex_point_map` | property map | the mesh's own | from vertices to points |
/// | `vertex_status_map` and so on | readable property maps | none | see annotate() and annotate_by_fit() |
/// | `comments` | range of std::string | none | comments of a PLY file |
///
/// `geom_traits` and `verbose` are accepted for compatibility with CGAL and ignored.
///
/// \throw Input_error if the file cannot be written, its format is unknown, or two columns would have the same name
/// \throw std::invalid_argument if a coordinate is not finite
template <Face_graph Graph, internal::Parameter_chain... Parameters>
void write_polygon_mesh(const std::string& path, const Graph& mesh, const Parameters&... given) {
  internal::check_map_file_parameters<internal::Joined_parameters<Parameters...>, internal::Vertex_point_tag,
                                      internal::Comments_tag>();
  const auto parameters = internal::joined_parameters(given...);
  internal::write_polygon_file(path, indexed_polygons_of_graph(mesh, parameters),
                               internal::columns_of_maps(mesh, vertices_of(mesh), parameters));
}

/// \cond
// Explain wrong arguments, see base/named_parameters.h.
template <class File, Face_graph Graph, class... Others>
void read_polygon_mesh(const File&, const Graph&,
                       const Others&...) requires(!std::convertible_to<File, std::string> ||
                                                  !(internal::Parameter_chain<Others> && ...)) {
  static_assert(std::convertible_to<File, std::string>, "the first argument must be the path of a file, a std::string");
  internal::explain_parameters<Others...>();
}
template <class File, Face_graph Graph, class... Others>
void write_polygon_mesh(const File&, const Graph&,
                        const Others&...) requires(!std::convertible_to<File, std::string> ||
                                                   !(internal::Parameter_chain<Others> && ...)) {
  static_assert(std::convertible_to<File, std::string>, "the first argument must be the path of a file, a std::string");
  internal::explain_parameters<Others...>();
}
/// \endcond

} // namespace equiaffine::IO

#endif
