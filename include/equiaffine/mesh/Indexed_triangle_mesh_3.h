// SPDX-License-Identifier: GPL-3.0-or-later
// Triangle meshes and polylines as plain arrays, statistics of samplers, and numbers attached to points.
#ifndef EQUIAFFINE_MESH_INDEXED_TRIANGLE_MESH_3_H
#define EQUIAFFINE_MESH_INDEXED_TRIANGLE_MESH_3_H

#include <equiaffine/geometry/Point_status.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// A triangle mesh as plain arrays: `triangles[t]` contains three indices into `points`, counterclockwise as seen from
/// the side to which the surface's normals point.
template <class Kernel>
struct Indexed_triangle_mesh_3 {
  std::vector<typename Kernel::Point_3> points;        ///< the vertices
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< three indices each
};

/// Adds equal shares of the area of a polygon, a range of indices of points, to the areas of its corners. The area of a
/// polygon with more than three corners is that of its projection along the sum of the normals of a fan of triangles.
template <class Points, class Polygon>
void add_vertex_areas(const Points& points, const Polygon& polygon, std::vector<double>& areas) {
  const auto& p = points[polygon[0]];
  auto normal = cross_product(points[polygon[1]] - p, points[polygon[2]] - p);
  for (std::size_t n = 3; n < polygon.size(); ++n)
    normal = normal + cross_product(points[polygon[n - 1]] - p, points[polygon[n]] - p);
  const double share = std::sqrt(CGAL::to_double(normal.squared_length())) / double(2 * polygon.size());
  for (const auto corner : polygon) areas[corner] += share;
}

/// Returns the area of a mesh at each vertex: a third of the area of the triangles around it, or 1/n for polygons with
/// n corners. Takes linear time.
template <class Points, class Polygons>
std::vector<double> vertex_areas(const Points& points, const Polygons& polygons) {
  std::vector<double> areas(points.size(), 0.);
  for (const auto& polygon : polygons) add_vertex_areas(points, polygon, areas);
  return areas;
}

/// A polyline, open or closed. A closed one does not repeat its first point.
template <class Kernel>
struct Polyline_3 {
  std::vector<typename Kernel::Point_3> points; ///< the points in order
  bool is_closed = false;                       ///< whether the last point is connected to the first one
};

/// Counts of the repairs that keep a surface a mesh of nondegenerate triangles.
struct Isosurface_repairs {
  std::size_t contracted_edges = 0;   ///< zero-length edges contracted without change of topology
  std::size_t dropped_components = 0; ///< closed parts of zero area, where the function only touches zero
  std::size_t moved_vertices = 0;     ///< moved along their grid edge, by at most 1e-6 of it or a few roundings
  std::size_t zero_area_left = 0;     ///< remaining triangles of zero area
  std::size_t flips_undone = 0; ///< vertices returned to their linear position because projection flipped a triangle
  std::size_t vertices_at_poles = 0; ///< vertices removed at poles, jumps and ends of the domain
};

/// The result of sampling the zero set of a function: a mesh with statistics.
template <class Kernel>
struct Isosurface_3 : Indexed_triangle_mesh_3<Kernel> {
  /// One per point: REGULAR, or UNCONVERGED if the point could not be moved onto the surface and stays at its linear
  /// position.
  std::vector<Point_status> vertex_status;
  Isosurface_repairs repairs;           ///< counts of repairs
  std::size_t function_evaluations = 0; ///< evaluations of f, with or without derivatives
  double sampling_seconds = 0,          ///< time to evaluate the function and to create the mesh
      projection_seconds = 0;           ///< time to move vertices onto the surface
};

/// Optional inputs for the attributes of points, as views. Each is empty or has one entry per point.
struct Sampled_vertices {
  std::span<const Point_status> status; ///< from the sampler
  std::span<const double> areas;        ///< from vertex_areas()

  Sampled_vertices() = default; ///< no inputs
  /// `statuses` is any contiguous range of Point_status.
  template <std::convertible_to<std::span<const Point_status>> Statuses>
  Sampled_vertices(const Statuses& statuses, std::span<const double> vertex_areas = {})
      : status(statuses), areas(vertex_areas) {}

  /// Returns the entries of `count` points, starting at `first`.
  Sampled_vertices part(std::size_t first, std::size_t count) const {
    const auto part_of = [&](auto span) { return span.empty() ? span : span.subspan(first, count); };
    return {part_of(status), part_of(areas)};
  }
};

/// Numbers attached to points, one column per scalar in the order of the file, and optionally the status. Missing
/// numbers are NaN.
struct Vertex_attributes {
  /// A named column of numbers.
  struct Column {
    std::string name;           ///< as in the header of a file
    std::vector<double> values; ///< one per point
  };
  std::vector<Column> columns;                     ///< in the order of the file
  std::optional<std::vector<Point_status>> status; ///< one per point
  std::vector<std::string> comments = {};          ///< comments on the numbers, stored only in PLY files

  /// Whether every column and, if present, the status have `size` entries.
  bool has_length(std::size_t size) const {
    return (!status || status->size() == size) &&
           std::all_of(columns.begin(), columns.end(), [&](const Column& c) { return c.values.size() == size; });
  }
};

/// Returns the column with this name, or null.
inline const Vertex_attributes::Column* find_column(const Vertex_attributes& attributes, std::string_view name) {
  for (const auto& column : attributes.columns)
    if (column.name == name) return &column;
  return nullptr;
}

/// A mesh, or only points, with the numbers attached to the points.
template <class Kernel>
struct Annotated_mesh_3 {
  Indexed_triangle_mesh_3<Kernel> mesh; ///< without triangles for points only
  Vertex_attributes attributes;         ///< columns, status and comments
};

} // namespace equiaffine

#endif
