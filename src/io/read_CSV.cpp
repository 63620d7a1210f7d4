// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/Csv_scanner.h"
#include "io/text_input.h"
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/internal/mesh_readers.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine::internal {

namespace {

/// The columns named x, y and z, or else X, Y and Z. Fails unless there is one of each.
std::array<std::size_t, 3> find_coordinates(const Csv_scanner& scanner, const std::vector<std::string>& header) {
  std::array<std::size_t, 3> places{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto columns = [&](const std::string& name) {
      return std::count_if(header.begin(), header.end(), [&](const auto& cell) { return unquote(cell) == name; });
    };
    const std::string lower(1, "xyz"[axis]), upper(1, "XYZ"[axis]), &name = columns(lower) == 0 ? upper : lower;
    if (columns(name) != 1)
      scanner.fail("its header has no single column '" + lower + "'",
                   "the first line names the columns, with x, y and z among them, separated by commas, semicolons or "
                   "tabs");
    places[axis] = std::size_t(
        std::find_if(header.begin(), header.end(), [&](const auto& cell) { return unquote(cell) == name; }) -
        header.begin());
  }
  return places;
}

/// Fails unless the row taken last has as many cells as the header.
void check_length(const Csv_scanner& scanner, const std::vector<std::string_view>& row,
                  const std::vector<std::string>& header) {
  const std::string line = "line " + std::to_string(scanner.line_number());
  if (row.size() < header.size())
    scanner.fail(line + ", column '" + unquote(header[row.size()]) + "': the cell is missing",
                 "write as many cells as the header has");
  if (row.size() > header.size())
    scanner.fail(line + " has more cells than the header",
                 std::string("write as many, or put quotes around '") + scanner.separator() + "'");
}

/// The point in the row taken last, whose coordinates are in the columns `places`.
std::array<double, 3> parse_point(const Csv_scanner& scanner, const std::vector<std::string_view>& row,
                                  const std::array<std::size_t, 3>& places) {
  std::array<double, 3> p{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string cell = unquote(row[places[axis]]);
    const std::optional<double> value = parse_number<double>(cell);
    if (!value)
      scanner.fail("line " + std::to_string(scanner.line_number()) + ", column '" + "xyz"[axis] + "': '" + cell +
                       "' is not a number",
                   cell.find(',') == std::string::npos ? "correct the cell" : "write decimal points, as in 0.5");
    p[axis] = *value;
  }
  return p;
}

/// The columns of numbers other than the coordinates: those all of whose cells are numbers.
std::vector<Vertex_attributes::Column> numeric_columns(const std::vector<std::string>& header,
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

} // namespace

Csv_cells read_CSV_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver) {
  const std::string text = read_all(stream);
  Csv_scanner scanner(text, name);
  Csv_cells table;
  table.separator = scanner.separator();
  for (const std::string_view cell : scanner.next_row()) table.header.emplace_back(cell);
  const auto coordinates = find_coordinates(scanner, table.header);
  for (auto row = scanner.next_row(); !row.empty(); row = scanner.next_row()) {
    check_length(scanner, row, table.header);
    const auto [x, y, z] = parse_point(scanner, row, coordinates);
    receiver.add_point(x, y, z);
    table.cells.insert(table.cells.end(), row.begin(), row.end());
  }
  table.columns = numeric_columns(table.header, table.cells, coordinates);
  return table;
}

} // namespace equiaffine::internal
