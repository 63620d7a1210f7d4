// SPDX-License-Identifier: GPL-3.0-or-later
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

} // namespace equiaffine

#endif
