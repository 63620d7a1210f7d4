// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_POINTS_H
#define EQUIAFFINE_IO_READ_POINTS_H

// Points from CSV, PLY and OFF with all that came with them, and back to CSV with more columns.

#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/read_OFF.h>
#include <equiaffine/io/read_PLY.h>
#include <equiaffine/io/text_input.h>
#include <equiaffine/io/write_CSV.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iostream>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine {

/// Points as they came from a file. `attributes` holds the columns of numbers other than x, y, z. From CSV there are
/// also the cells as they were written (blanks and quotes included), `header.size()` per row.
template <class Kernel>
struct Point_table_3 : Annotated_mesh_3<Kernel> {
  std::vector<std::string> header;
  std::vector<std::string> cells;
};

namespace internal {

/// A cell of a CSV file without the quotes around it.
inline std::string unquote(std::string_view cell) {
  cell = trim(cell);
  if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return std::string(cell);
  std::string text;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    text += cell[i];
    if (cell[i] == '"' && cell[i + 1] == '"') ++i;
  }
  return text;
}

/// Takes the cells of the next row off the text of a CSV file, blank lines skipped; empty at the end. A quoted cell may
/// hold commas and line ends.
class Csv_scanner {
public:
  Csv_scanner(std::string_view text, const std::string& name) : rest_(text), name_(name) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  }

  [[noreturn]] void fail(const std::string& reason, const std::string& advice) const {
    throw Input_error("cannot read '" + name_ + "': " + reason + "; " + advice);
  }

  /// The line in which the row taken last begins.
  std::size_t line_number() const { return line_number_; }

  std::vector<std::string_view> row() {
    std::size_t end = 0;
    do {
      line_number_ = next_line_number_;
      rest_.remove_prefix(end);
      end = end_of_row();
    } while (end > 0 && trim(rest_.substr(0, end)).empty());
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return split(text);
  }

private:
  /// The length of the next row, its line end included.
  std::size_t end_of_row() {
    bool is_quoted = false;
    for (std::size_t i = 0; i < rest_.size(); ++i) {
      if (rest_[i] == '"') is_quoted = !is_quoted;
      if (rest_[i] != '\n') continue;
      ++next_line_number_;
      if (!is_quoted) return i + 1;
    }
    if (is_quoted) fail("line " + std::to_string(line_number_) + " opens a quote that is never closed", "close it");
    return rest_.size();
  }

  static std::vector<std::string_view> split(std::string_view text) {
    if (text.ends_with('\n')) text.remove_suffix(1);
    if (text.ends_with('\r')) text.remove_suffix(1);
    std::vector<std::string_view> cells;
    if (text.empty()) return cells;
    bool is_quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '"') is_quoted = !is_quoted;
      if (text[i] != ',' || is_quoted) continue;
      cells.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
    cells.push_back(text.substr(begin));
    return cells;
  }

  std::string_view rest_;
  const std::string& name_;
  std::size_t line_number_ = 1;
  std::size_t next_line_number_ = 1;
};

/// The places of the columns x, y, z.
inline std::array<std::size_t, 3> find_coordinates(const Csv_scanner& scanner, const std::vector<std::string>& header) {
  std::array<std::size_t, 3> places{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string name(1, "xyz"[axis]);
    const auto is_name = [&](const std::string& cell) { return unquote(cell) == name; };
    if (std::count_if(header.begin(), header.end(), is_name) != 1)
      scanner.fail("its header has no single column '" + name + "'",
                   "the first line names the columns, with x, y and z among them, separated by commas");
    places[axis] = std::size_t(std::find_if(header.begin(), header.end(), is_name) - header.begin());
  }
  return places;
}

/// The columns all of whose cells are numbers.
inline std::vector<Vertex_attributes::Column> numeric_columns(const std::vector<std::string>& header,
                                                              const std::vector<std::string>& cells,
                                                              const std::array<std::size_t, 3>& coordinates) {
  std::vector<Vertex_attributes::Column> columns;
  for (std::size_t column = 0; column < header.size(); ++column) {
    if (std::find(coordinates.begin(), coordinates.end(), column) != coordinates.end()) continue;
    std::vector<double> values;
    for (std::size_t cell = column; cell < cells.size(); cell += header.size()) {
      const std::optional<double> value = parse_number<double>(unquote(cells[cell]));
      if (!value) break;
      values.push_back(*value);
    }
    if (values.size() * header.size() == cells.size()) columns.push_back({unquote(header[column]), std::move(values)});
  }
  return columns;
}

} // namespace internal

/// Reads a CSV file whose header names x, y, z in any places. `name` stands for the file in messages. Throws
/// `Input_error` with line and column for a cell that is missing, and for a coordinate that is not a number. A
/// number is also nan or inf: such a point is nowhere.
template <class Kernel>
Point_table_3<Kernel> read_CSV(std::istream& stream, const std::string& name) {
  const std::string text = internal::read_all(stream);
  internal::Csv_scanner scanner(text, name);
  Point_table_3<Kernel> table;
  for (const std::string_view cell : scanner.row()) table.header.emplace_back(cell);
  const auto coordinates = internal::find_coordinates(scanner, table.header);
  const std::string advice = "correct the cell";
  for (auto row = scanner.row(); !row.empty(); row = scanner.row()) {
    const std::string line = "line " + std::to_string(scanner.line_number());
    if (row.size() < table.header.size())
      scanner.fail(line + ", column '" + internal::unquote(table.header[row.size()]) + "': the cell is missing",
                   "write as many cells as the header has");
    if (row.size() > table.header.size())
      scanner.fail(line + " has more cells than the header", "write as many, or put quotes around commas");
    std::array<double, 3> p{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::string cell = internal::unquote(row[coordinates[axis]]);
      const std::optional<double> value = internal::parse_number<double>(cell);
      if (!value) scanner.fail(line + ", column '" + "xyz"[axis] + "': '" + cell + "' is not a number", advice);
      p[axis] = *value;
    }
    table.mesh.points.emplace_back(p[0], p[1], p[2]);
    table.cells.insert(table.cells.end(), row.begin(), row.end());
  }
  table.attributes.columns = internal::numeric_columns(table.header, table.cells, coordinates);
  return table;
}

/// Reads points from `.csv`, `.ply` or `.off`, or from standard input for "-": PLY or OFF if the first word says so,
/// otherwise CSV.
template <class Kernel>
Point_table_3<Kernel> read_points(const std::string& path) {
  const auto read = [](std::istream& stream, const std::string& name, std::string_view extension) {
    if (extension == ".ply") return Point_table_3<Kernel>{read_PLY<Kernel>(stream, name), {}, {}};
    if (extension == ".off") return Point_table_3<Kernel>{{read_OFF<Kernel>(stream, name), {}}, {}, {}};
    return read_CSV<Kernel>(stream, name);
  };
  if (path == "-") {
    std::string text = internal::read_all(std::cin);
    std::string_view rest = text;
    const std::string_view word = internal::take_word(rest);
    const char* const extension = word == "ply" ? ".ply" : word.ends_with("OFF") ? ".off" : ".csv";
    std::istringstream stream(std::move(text));
    return read(stream, "standard input", extension);
  }
  std::ifstream file = internal::open_input(path);
  for (const std::string_view extension : {".csv", ".ply", ".off"})
    if (internal::has_extension(path, extension)) return read(file, path, extension);
  throw Input_error("cannot read '" + path + "': its extension is not known; use one of .csv .ply .off");
}

/// The columns of `first` that `second` does not have, then those of `second`; the status of `second` if it has one.
inline Vertex_attributes merge_attributes(Vertex_attributes first, const Vertex_attributes& second) {
  std::erase_if(first.columns, [&](const auto& old) {
    return std::any_of(second.columns.begin(), second.columns.end(), [&](const auto& c) { return c.name == old.name; });
  });
  first.columns.insert(first.columns.end(), second.columns.begin(), second.columns.end());
  if (second.status) first.status = second.status;
  return first;
}

/// Writes the rows of `table` as they came, then the columns of `attributes` and the status; these replace columns of
/// the same names.
template <class Kernel>
void write_CSV(std::ostream& stream, const Point_table_3<Kernel>& table, const Vertex_attributes& attributes) {
  if (table.header.empty()) return write_CSV(stream, table.mesh.points, merge_attributes(table.attributes, attributes));
  std::vector<std::size_t> kept;
  for (std::size_t column = 0; column < table.header.size(); ++column) {
    const std::string name = internal::unquote(table.header[column]);
    const bool is_replaced =
        (name == "status" && attributes.status) || std::any_of(attributes.columns.begin(), attributes.columns.end(),
                                                               [&](const auto& c) { return c.name == name; });
    if (!is_replaced) kept.push_back(column);
  }
  internal::Buffered_output out(stream);
  const auto write_row = [&](const std::vector<std::string>& cells, std::size_t begin) {
    for (std::size_t i = 0; i < kept.size(); ++i) out << (i == 0 ? "" : ",") << cells[begin + kept[i]];
  };
  write_row(table.header, 0);
  internal::write_CSV_rows(out, table.mesh.points.size(), attributes,
                           [&](std::size_t row) { write_row(table.cells, row * table.header.size()); });
}

} // namespace equiaffine

#endif
