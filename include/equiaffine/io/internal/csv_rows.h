// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_CSV_ROWS_H
#define EQUIAFFINE_IO_INTERNAL_CSV_ROWS_H

#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/assertions.h>

#include <cstddef>

// The library defines the function that has no body here.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Writes the rest of the header line.
void write_CSV_names(Buffered_output& out, const Vertex_attributes& attributes, char separator);

/// Writes rows: `write(row)` writes what comes first in a line; the numbers of `attributes` and the word for the status
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

#endif
