// SPDX-License-Identifier: GPL-3.0-or-later
// Triangle meshes and polylines as plain arrays, what samplers tell of their meshes, and numbers attached to points.
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

/// A triangle mesh as plain arrays: `triangles[t]` holds three indices into `points`, counterclockwise seen from the
/// side to which the surface's normals point.
template <class Kernel>
struct Indexed_triangle_mesh_3 {
  std::vector<typename Kernel::Point_3> points;        ///< the vertices
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< three indices each
};

/// Adds its share in the area of a polygon, a range of indices of points, to the area of each corner. The area of a
/// polygon with more than three corners is that of its projection along the sum of the normals of a fan.
template <class Points, class Polygon>
void add_vertex_areas(const Points& points, const Polygon& polygon, std::vector<double>& areas) {
  const auto& p = points[polygon[0]];
  auto normal = cross_product(points[polygon[1]] - p, points[polygon[2]] - p);
  for (std::size_t n = 3; n < polygon.size(); ++n)
    normal = normal + cross_product(points[polygon[n - 1]] - p, points[polygon[n]] - p);
  const double share = std::sqrt(CGAL::to_double(normal.squared_length())) / double(2 * polygon.size());
  for (const auto corner : polygon) areas[corner] += share;
}

/// Returns the area of a mesh around each vertex: a third of that of the triangles around it, or the n-th part for
/// polygons with n corners. Linear in the size of the mesh.
template <class Points, class Polygons>
std::vector<double> vertex_areas(const Points& points, const Polygons& polygons) {
  std::vector<double> areas(points.size(), 0.);
  for (const auto& polygon : polygons) add_vertex_areas(points, polygon, areas);
  return areas;
}

/// A chain of points, closed or not. A closed one does not repeat its first point.
template <class Kernel>
struct Polyline_3 {
  std::vector<typename Kernel::Point_3> points; ///< in their order
  bool is_closed = false;                       ///< whether the first point follows the last one
};

/// Counts of the repairs by which a surface remains a mesh of proper triangles.
struct Isosurface_repairs {
  std::size_t contracted_edges = 0;   ///< edges without length, contracted without change of topology
  std::size_t dropped_components = 0; ///< closed parts without area, where the function only touches zero
  std::size_t moved_vertices = 0;     ///< moved along their grid edge, by at most 1e-6 of it or a few roundings
  std::size_t zero_area_left = 0;     ///< triangles for which none of this helped
  std::size_t flips_undone = 0; ///< vertices put back to their linear position since projection turned a triangle over
  std::size_t vertices_at_poles = 0; ///< removed with their triangles, at poles, jumps and ends of the function
};

/// The result of sampling the zero set of a function: a mesh and facts about it.
template <class Kernel>
struct Isosurface_3 : Indexed_triangle_mesh_3<Kernel> {
  /// One per point: REGULAR, or UNCONVERGED if the point could not be put on the surface and stays at its linear
  /// position.
  std::vector<Point_status> vertex_status;
  Isosurface_repairs repairs;           ///< what was repaired
  std::size_t function_evaluations = 0; ///< of f, with or without derivatives
  double sampling_seconds = 0,          ///< the time that it took to evaluate the function and to make the mesh
      projection_seconds = 0;           ///< the time that it took to put vertices on the surface
};

/// Optional inputs for the attributes of points, as views. Each is empty, or has one entry per point.
struct Sampled_vertices {
  std::span<const Point_status> status; ///< of the sampler
  std::span<const double> areas;        ///< of vertex_areas()

  Sampled_vertices() = default; ///< nothing is known
  /// `statuses` is any contiguous range of Point_status.
  template <std::convertible_to<std::span<const Point_status>> Statuses>
  Sampled_vertices(const Statuses& statuses, std::span<const double> vertex_areas = {})
      : status(statuses), areas(vertex_areas) {}

  /// Returns those of `count` points from the given one on.
  Sampled_vertices part(std::size_t first, std::size_t count) const {
    const auto part_of = [&](auto span) { return span.empty() ? span : span.subspan(first, count); };
    return {part_of(status), part_of(areas)};
  }
};

/// Numbers attached to points, one column per scalar in the order of the file, and the status, if it was asked for. A
/// number that does not exist is NaN.
struct Vertex_attributes {
  /// A name and the numbers of that name.
  struct Column {
    std::string name;           ///< as in the header of a file
    std::vector<double> values; ///< one per point
  };
  std::vector<Column> columns;                     ///< in the order of the file
  std::optional<std::vector<Point_status>> status; ///< one per point
  std::vector<std::string> comments = {};          ///< lines of text on the numbers, which only PLY keeps

  /// Whether every column and the status, if there is one, have `size` entries.
  bool has_length(std::size_t size) const {
    return (!status || status->size() == size) &&
           std::all_of(columns.begin(), columns.end(), [&](const Column& c) { return c.values.size() == size; });
  }
};

/// Returns the column of that name, or null.
inline const Vertex_attributes::Column* find_column(const Vertex_attributes& attributes, std::string_view name) {
  for (const auto& column : attributes.columns)
    if (column.name == name) return &column;
  return nullptr;
}

/// A mesh, or points alone, with the numbers that came with the points.
template <class Kernel>
struct Annotated_mesh_3 {
  Indexed_triangle_mesh_3<Kernel> mesh; ///< has no triangles if there are points alone
  Vertex_attributes attributes;         ///< columns, status and comments
};

} // namespace equiaffine

#endif
