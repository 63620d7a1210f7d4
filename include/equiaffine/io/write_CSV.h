// SPDX-License-Identifier: GPL-3.0-or-later
// Writes points and their attributes as CSV, at once or in parts.
#ifndef EQUIAFFINE_IO_WRITE_CSV_H
#define EQUIAFFINE_IO_WRITE_CSV_H

#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/assertions.h>

#include <array>
#include <cstddef>
#include <ostream>
#include <span>
#include <vector>

// The function without a body is compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Writes the names of the attributes to complete the header line.
void write_CSV_names(Buffered_output& out, const Vertex_attributes& attributes, char separator);

/// Writes rows: `write(row)` writes the beginning of a line; the numbers of `attributes` and the word for the status
/// follow.
template <class WriteRow>
void write_CSV_rows(Buffered_output& out, std::size_t number_of_rows, const Vertex_attributes& attributes,
                    char separator, const WriteRow& write) {
  CGAL_precondition(attributes.has_length(number_of_rows));
  for (std::size_t row = 0; row < number_of_rows; ++row) {
    write(row);
    for (const auto& column : attributes.columns) out << separator << column.values[row];
    if (attributes.status) out << separator << to_string((*attributes.status)[row]);
    out << '\n';
  }
  out.flush();
}

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

namespace equiaffine {

/// Writes points with their attributes as CSV in parts: the header, then all points in any number of parts.
class Csv_writer {
public:
  /// Writes the header. Only the names of the columns in `layout` are used, and whether it has a status.
  Csv_writer(std::ostream& stream, const Vertex_attributes& layout) : out_(stream) {
    out_ << "x,y,z";
    internal::write_CSV_names(out_, layout, ',');
    out_.flush();
  }

  /// Writes the next points.
  template <class Point>
  void write_points(std::span<const Point> points, const Vertex_attributes& attributes) {
    internal::write_CSV_rows(out_, points.size(), attributes, ',', [&](std::size_t row) {
      const std::array<double, 3> p = internal::coordinates(points[row]);
      out_ << p[0] << ',' << p[1] << ',' << p[2];
    });
  }

private:
  internal::Buffered_output out_;
};

/// Writes one line per point after the header `x,y,z,<columns>,status`: numbers with 17 significant digits, `nan` for
/// missing ones, and the status as a word. Errors are reported by the state of the stream.
template <class Point_3>
void write_CSV(std::ostream& stream, const std::vector<Point_3>& points, const Vertex_attributes& attributes = {}) {
  Csv_writer(stream, attributes).write_points(std::span<const Point_3>(points), attributes);
}

} // namespace equiaffine

#endif
