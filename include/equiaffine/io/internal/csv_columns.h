// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_CSV_COLUMNS_H
#define EQUIAFFINE_IO_INTERNAL_CSV_COLUMNS_H

#include <equiaffine/io/internal/Csv_scanner.h>
#include <equiaffine/io/internal/text_input.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The columns named x, y and z, or else X, Y and Z. Fails unless there is one of each.
inline std::array<std::size_t, 3> find_coordinates(const Csv_scanner& scanner, const std::vector<std::string>& header) {
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
inline void check_length(const Csv_scanner& scanner, const std::vector<std::string_view>& row,
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
inline std::array<double, 3> parse_point(const Csv_scanner& scanner, const std::vector<std::string_view>& row,
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

/// The columns of a file that stay when `attributes` are written beside them: those of other names.
inline std::vector<std::size_t> columns_to_keep(const std::vector<std::string>& header,
                                                const Vertex_attributes& attributes) {
  std::vector<std::size_t> kept;
  for (std::size_t column = 0; column < header.size(); ++column) {
    const std::string name = unquote(header[column]);
    const bool is_replaced =
        (name == "status" && attributes.status) || std::any_of(attributes.columns.begin(), attributes.columns.end(),
                                                               [&](const auto& c) { return c.name == name; });
    if (!is_replaced) kept.push_back(column);
  }
  return kept;
}

} // namespace equiaffine::internal

#endif
