// SPDX-License-Identifier: GPL-3.0-or-later
// Reads points, with or without faces and attributes, from CSV, XYZ, PLY, OFF, OBJ, or STL files, and writes them to
// CSV with additional columns.
#ifndef EQUIAFFINE_IO_READ_POINTS_H
#define EQUIAFFINE_IO_READ_POINTS_H

#include <equiaffine/base/internal/compiler.h>
#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/write_CSV.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/mesh/internal/triangles_of_polygon.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <functional>
#include <iostream>
#include <istream>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The functions that a reader calls with the elements of a file, so that the readers do not depend on the kernel.
struct Mesh_receiver {
  std::function<void(std::size_t points, std::size_t faces)> reserve; ///< before the points, with the declared numbers
  std::function<void(double x, double y, double z)> add_point;
  std::function<void(const std::vector<std::uint32_t>& face)> add_face; ///< indices of points that were added
};

/// Adds the points to a mesh, and the faces as triangles.
template <class Kernel>
Mesh_receiver receiver_of(Indexed_triangle_mesh_3<Kernel>& mesh) {
  return {[&](std::size_t points, std::size_t faces) {
            mesh.points.reserve(points);
            mesh.triangles.reserve(faces);
          },
          [&](double x, double y, double z) { mesh.points.emplace_back(x, y, z); },
          [&](const std::vector<std::uint32_t>& face) { add_triangles_of_polygon(mesh.points, face, mesh.triangles); }};
}

/// The header, the cells, and the columns of a table of points.
struct Csv_cells {
  std::vector<std::string> header, cells; ///< the cells as written, row by row
  char separator = ',';
  std::vector<Vertex_attributes::Column> columns; ///< those in which all cells are numbers
};

// These functions are compiled into the library. `name` is the name of the file in messages.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Reads PLY, and returns the attributes of the points.
Vertex_attributes read_PLY_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver);

/// Reads OFF, OBJ, or STL.
void read_OFF_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver);
void read_OBJ_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver);
void read_STL_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver);

/// Reads XYZ, and returns the attributes of the points.
Vertex_attributes read_XYZ_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver);

/// Reads CSV.
Csv_cells read_CSV_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver);

/// The extension of a file with the given text: `.ply` or `.off` depending on its first word, otherwise `.csv`.
const char* extension_of_text(std::string_view text);

/// The columns of a file that are not replaced by `attributes`, because their names differ.
std::vector<std::size_t> columns_to_keep(const std::vector<std::string>& header, const Vertex_attributes& attributes);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

} // namespace equiaffine::internal

namespace equiaffine {

/// Points read from a file. `attributes` has the columns of numbers other than x, y, z. For CSV there are also the
/// names of all columns, the cells as written (including blanks and quotes), and the separator.
template <class Kernel>
struct Point_table_3 : Annotated_mesh_3<Kernel> {
  std::vector<std::string> header = {}; ///< names of the columns
  std::vector<std::string> cells = {};  ///< row by row
  char separator = ',';                 ///< the character between cells
};

/// Reads a CSV file whose header contains x, y, z (or X, Y, Z) anywhere. The separator is a comma, a semicolon, or a
/// tab, whichever is most frequent in the header. `name` is the name of the file in messages. The words nan and inf
/// count as numbers; functions have no value at such a point. Throws `Input_error` with line and column for a missing
/// cell, or a coordinate that is not a number.
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

/// Reads PLY (text or binary): the points, every other scalar property of the vertices as a column, `uchar status` as
/// the status, the comments, and the faces, if any, which are triangulated. Ignores list properties of vertices and
/// other elements. `name` is the name of the file in messages. Throws `Input_error` unless the file is a complete PLY
/// file.
template <class Kernel>
Annotated_mesh_3<Kernel> read_PLY(std::istream& stream, const std::string& name) {
  Annotated_mesh_3<Kernel> result;
  result.attributes = internal::read_PLY_elements(stream, name, internal::receiver_of(result.mesh));
  return result;
}

/// Reads the points and faces of a text OFF file with one line per vertex and face. Faces are triangulated. Ignores
/// normals and colors. `name` is the name of the file in messages. Throws `Input_error` unless the file is complete.
template <class Kernel>
Indexed_triangle_mesh_3<Kernel> read_OFF(std::istream& stream, const std::string& name) {
  Indexed_triangle_mesh_3<Kernel> mesh;
  internal::read_OFF_elements(stream, name, internal::receiver_of(mesh));
  return mesh;
}

/// Reads OBJ: points and faces, which are triangulated. Ignores normals, textures, colors, lines, and groups. `name`
/// is the name of the file in messages. Throws `Input_error` if the file is not an OBJ file, or has faces with
/// nonexistent vertices.
template <class Kernel>
Indexed_triangle_mesh_3<Kernel> read_OBJ(std::istream& stream, const std::string& name) {
  Indexed_triangle_mesh_3<Kernel> mesh;
  internal::read_OBJ_elements(stream, name, internal::receiver_of(mesh));
  return mesh;
}

/// Reads the triangles of a binary or text STL file; corners with equal coordinates become one point. Ignores normals.
/// `name` is the name of the file in messages. Throws `Input_error` unless the file is complete.
template <class Kernel>
Indexed_triangle_mesh_3<Kernel> read_STL(std::istream& stream, const std::string& name) {
  Indexed_triangle_mesh_3<Kernel> mesh;
  internal::read_STL_elements(stream, name, internal::receiver_of(mesh));
  return mesh;
}

/// A comment added to the points of an XYZ file if its columns 4 to 6 have no names and are not normals.
inline constexpr const char* xyz_colors_note = "columns 4 to 6 are colors; normals would have length 1";

/// Reads points as lines of x y z, or of x y z and three more numbers, separated by blanks. The three numbers are read
/// as normals (columns nx, ny, nz) if their length is about 1, and otherwise as colors (columns red, green, blue); in
/// the latter case, a comment of the result says so. A first line such as `//X Y Z R G B`, as written by CloudCompare,
/// or `# x y z intensity` names any columns. Ignores empty lines and other lines that begin with // or #. `name` is the
/// name of the file in messages. Throws `Input_error` for any other line, and for numbers that are neither normals nor
/// colors.
template <class Kernel>
Annotated_mesh_3<Kernel> read_XYZ(std::istream& stream, const std::string& name) {
  Annotated_mesh_3<Kernel> result;
  result.attributes = internal::read_XYZ_elements(stream, name, internal::receiver_of(result.mesh));
  return result;
}

/// Reads points in the format of `extension`, which ends with `.csv`, `.ply`, `.off`, `.obj`, `.stl`, or `.xyz`.
/// `name` is the name of the file in messages. Throws `Input_error` unless the file is complete and in this format.
template <class Kernel>
Point_table_3<Kernel> read_points(std::istream& stream, const std::string& name, std::string_view extension) {
  if (has_extension(extension, ".csv")) return read_CSV<Kernel>(stream, name);
  if (has_extension(extension, ".ply")) return {read_PLY<Kernel>(stream, name)};
  if (has_extension(extension, ".off")) return {{read_OFF<Kernel>(stream, name), {}}};
  if (has_extension(extension, ".obj")) return {{read_OBJ<Kernel>(stream, name), {}}};
  if (has_extension(extension, ".stl")) return {{read_STL<Kernel>(stream, name), {}}};
  if (has_extension(extension, ".xyz")) return {read_XYZ<Kernel>(stream, name)};
  internal::fail_to_read(name, "its extension is not known", "use one of .csv .ply .off .obj .stl .xyz");
}

/// Reads points from the file at `path`, in the format of its extension, or from standard input for "-": PLY or OFF
/// depending on the first word, otherwise CSV.
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

// This function is compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif

/// Returns the columns of `first` that `second` does not have, followed by those of `second`, and the status of
/// `second`, or that of `first` if it has none. Comments with the same text before the colon are replaced likewise.
Vertex_attributes merge_attributes(Vertex_attributes first, const Vertex_attributes& second);

#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

/// Writes the rows of `table`, with their separator and with every cell as it was read, followed by the columns of
/// `attributes` and the status; columns of `table` with the same names are left out.
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
