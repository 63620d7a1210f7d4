// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_CSV_WRITER_H
#define EQUIAFFINE_IO_INTERNAL_CSV_WRITER_H

#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/io/internal/csv_rows.h>
#include <equiaffine/io/internal/mesh_text.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <array>
#include <cstddef>
#include <ostream>
#include <span>

namespace equiaffine {

/// Writes points with their attributes as CSV part by part: the header, then all points in any number of parts.
class Csv_writer {
public:
  /// Writes the header. `layout` has the names of the columns, and whether there is a status; what numbers it has does
  /// not matter.
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

} // namespace equiaffine

#endif
