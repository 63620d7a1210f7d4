// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_WRITE_CSV_H
#define EQUIAFFINE_IO_WRITE_CSV_H

#include <equiaffine/io/internal/Csv_writer.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <ostream>
#include <span>
#include <vector>

namespace equiaffine {

/// Writes a line per point after the header `x,y,z,<columns>,status`: numbers with 17 significant digits, `nan` for
/// those that do not exist, the status as a word. Errors are in the state of the stream.
template <class Point_3>
void write_CSV(std::ostream& stream, const std::vector<Point_3>& points, const Vertex_attributes& attributes = {}) {
  Csv_writer(stream, attributes).write_points(std::span<const Point_3>(points), attributes);
}

} // namespace equiaffine

#endif
