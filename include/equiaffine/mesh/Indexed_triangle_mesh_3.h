// SPDX-License-Identifier: GPL-3.0-or-later
// Triangle meshes and polylines as plain arrays, what samplers tell of their meshes, and numbers attached to points.
#ifndef EQUIAFFINE_MESH_INDEXED_TRIANGLE_MESH_3_H
#define EQUIAFFINE_MESH_INDEXED_TRIANGLE_MESH_3_H

#include <equiaffine/geometry/Point_status.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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
