// SPDX-License-Identifier: GPL-3.0-or-later
// Reads points, with or without faces, from CSV, XYZ, PLY or OFF, as the name of a file says.
#ifndef EQUIAFFINE_IO_READ_POINTS_H
#define EQUIAFFINE_IO_READ_POINTS_H

// Reads points from CSV, PLY, OFF and XYZ with all that came with them, and writes them to CSV with more columns.

#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/io/internal/csv_rows.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/internal/mesh_readers.h>
#include <equiaffine/io/read_OFF.h>
#include <equiaffine/io/read_PLY.h>
#include <equiaffine/io/read_XYZ.h>
#include <equiaffine/io/write_CSV.h>
#include <equiaffine/mesh/Annotated_mesh_3.h>

#include <cstddef>
#include <fstream>
#include <iostream>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine {

/// Points as they came from a file. `attributes` holds the columns of numbers other than x, y, z. From CSV there are
/// also the names of all columns, the cells as they were written (blanks and quotes included), row by row, and the
/// character between them.
template <class Kernel>
struct Point_table_3 : Annotated_mesh_3<Kernel> {
  std::vector<std::string> header = {}; ///< names of the columns
  std::vector<std::string> cells = {};  ///< row by row
  char separator = ',';                 ///< the character between cells
};

/// Reads a CSV file whose header names x, y, z (or X, Y, Z) in any places. Cells are separated by commas, semicolons or
/// tabs, whatever the header has most. `name` stands for the file in messages. Throws
/// `Input_error` with line and column for a cell that is missing, and for a coordinate that is not a number. The words
/// nan and inf are numbers: no function has a value at such a point.
template <class Kernel>
Point_table_3<Kernel> read_CSV(std::istream& stream, const std::string& name) {
  Point_table_3<Kernel> table;
  internal::Csv_cells file = internal::read_CSV_elements(stream, name, internal::receiver_of(table.mesh));
  table.attributes.columns = std::move(file.columns);
  table.header = std::move(file.header);
  table.cells = std::move(file.cells);
  table.separator = file.separator;
  return table;
}

/// Reads points in the format that the end of `extension` stands for, `.csv`, `.ply`, `.off` or `.xyz`. `name` stands
/// for the file in messages. Throws `Input_error` for what is not a complete file of the format.
template <class Kernel>
Point_table_3<Kernel> read_points(std::istream& stream, const std::string& name, std::string_view extension) {
  if (has_extension(extension, ".csv")) return read_CSV<Kernel>(stream, name);
  if (has_extension(extension, ".ply")) return {read_PLY<Kernel>(stream, name)};
  if (has_extension(extension, ".off")) return {{read_OFF<Kernel>(stream, name), {}}};
  if (has_extension(extension, ".xyz")) return {read_XYZ<Kernel>(stream, name)};
  internal::fail_to_read(name, "its extension is not known", "use one of .csv .ply .off .xyz");
}

/// Reads points from such a file, or from standard input for "-": PLY or OFF if the first word says so, otherwise CSV.
template <class Kernel>
Point_table_3<Kernel> read_points(const std::string& path) {
  if (path == "-") {
    std::string text = internal::read_all(std::cin);
    const char* const extension = internal::extension_of_text(text);
    std::istringstream stream(std::move(text));
    return read_points<Kernel>(stream, "standard input", extension);
  }
  std::ifstream file = open_input(path);
  return read_points<Kernel>(file, path, path);
}

// The library defines this function.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// The columns of `first` that `second` does not have, then those of `second`; the status of `second` if it has one.
/// Comments likewise: those with the same text before the colon are replaced.
Vertex_attributes merge_attributes(Vertex_attributes first, const Vertex_attributes& second);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

/// Writes the rows of `table` as they came, with their separator, then the columns of `attributes` and the status;
/// these replace columns of the same names.
template <class Kernel>
void write_CSV(std::ostream& stream, const Point_table_3<Kernel>& table, const Vertex_attributes& attributes) {
  if (table.header.empty()) return write_CSV(stream, table.mesh.points, merge_attributes(table.attributes, attributes));
  const std::vector<std::size_t> kept = internal::columns_to_keep(table.header, attributes);
  internal::Buffered_output out(stream);
  const auto write_row = [&](const std::vector<std::string>& cells, std::size_t begin) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (i > 0) out << table.separator;
      out << cells[begin + kept[i]];
    }
  };
  write_row(table.header, 0);
  internal::write_CSV_names(out, attributes, table.separator);
  internal::write_CSV_rows(out, table.mesh.points.size(), attributes, table.separator,
                           [&](std::size_t row) { write_row(table.cells, row * table.header.size()); });
}

} // namespace equiaffine

#endif
