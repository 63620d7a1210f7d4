// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_WRITE_CSV_H
#define EQUIAFFINE_IO_WRITE_CSV_H

#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/io/internal/csv_rows.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <CGAL/number_utils.h>

#include <cstddef>
#include <ostream>
#include <vector>

namespace equiaffine {

/// Writes a line per point after the header `x,y,z,<columns>,status`: numbers with 17 significant digits, `nan` for
/// those that do not exist, the status as a word. Errors are in the state of the stream.
template <class Point_3>
void write_CSV(std::ostream& stream, const std::vector<Point_3>& points, const Vertex_attributes& attributes = {}) {
  internal::Buffered_output out(stream);
  out << "x,y,z";
  internal::write_CSV_rows(out, points.size(), attributes, ',', [&](std::size_t row) {
    const Point_3& p = points[row];
    out << CGAL::to_double(p.x()) << ',' << CGAL::to_double(p.y()) << ',' << CGAL::to_double(p.z());
  });
}

} // namespace equiaffine

#endif
