// SPDX-License-Identifier: GPL-3.0-or-later
// Reads tables of points as CSV, and merges their columns with new ones.
#include "io/text_input.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>
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

/// The text of a cell without the quotes around it. Within them, two quotes represent one.
std::string unquote(std::string_view cell) {
  cell = trim(cell);
  if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"') return std::string(cell);
  std::string text;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    text += cell[i];
    if (cell[i] == '"' && cell[i + 1] == '"') ++i;
  }
  return text;
}

/// The separator of a file with this header: the most frequent one of comma, semicolon, and tab.
char separator_of(std::string_view header) {
  const auto count = [&](char c) { return std::count(header.begin(), header.end(), c); };
  char separator = ',';
  for (const char c : {';', '\t'})
    if (count(c) > count(separator)) separator = c;
  return separator;
}

/// Splits the text of a CSV file into rows. A quoted cell may contain separators and line ends.
class Csv_scanner {
public:
  Csv_scanner(std::string_view text, const std::string& name) : rest_(text), name_(name) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
    const std::size_t first = std::min(rest_.find_first_not_of("\r\n"), rest_.size());
    separator_ = separator_of(rest_.substr(first, rest_.find('\n', first) - first));
  }

  /// The separator between cells.
  char separator() const { return separator_; }

  [[noreturn]] void fail(const std::string& reason, const std::string& advice) const {
    fail_to_read(name_, reason, advice);
  }

  /// The line in which the last row returned begins.
  std::size_t line_number() const { return line_number_; }

  /// Returns the cells of the next row that is not blank, as written; none at the end of the file.
  std::vector<std::string_view> next_row() {
    Progress_observer::step();
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
  /// The length of the next row, including its line end.
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

  /// Splits a row into cells.
  std::vector<std::string_view> split(std::string_view text) const {
    if (text.ends_with('\n')) text.remove_suffix(1);
    if (text.ends_with('\r')) text.remove_suffix(1);
    std::vector<std::string_view> cells;
    if (text.empty()) return cells;
    bool is_quoted = false;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '"') is_quoted = !is_quoted;
      if (text[i] != separator_ || is_quoted) continue;
      cells.push_back(text.substr(begin, i - begin));
      begin = i + 1;
    }
    cells.push_back(text.substr(begin));
    return cells;
  }

  std::string_view rest_;
  const std::string& name_;
  char separator_ = ',';
  std::size_t line_number_ = 1;
  std::size_t next_line_number_ = 1;
};

/// The indices of the columns x, y, and z, or else X, Y, and Z. Fails unless there is exactly one of each.
std::array<std::size_t, 3> find_coordinates(const Csv_scanner& scanner, const std::vector<std::string>& header) {
  std::array<std::size_t, 3> places{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto columns = [&](const std::string& name) {
      return std::count_if(header.begin(), header.end(), [&](const auto& cell) { return unquote(cell) == name; });
    };
    const std::string lower(1, "xyz"[axis]), upper(1, "XYZ"[axis]), &name = columns(lower) == 0 ? upper : lower;
    if (columns(name) != 1)
      scanner.fail("its header does not have exactly one column '" + lower + "'",
                   "name the columns in the first line, including x, y and z, separated by commas, semicolons or tabs");
    places[axis] = std::size_t(
        std::find_if(header.begin(), header.end(), [&](const auto& cell) { return unquote(cell) == name; }) -
        header.begin());
  }
  return places;
}

/// Fails unless the last row has as many cells as the header.
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

/// The point in the last row, whose coordinates are in the columns `places`.
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

/// The columns in which all cells are numbers, except the coordinates.
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

std::vector<std::size_t> columns_to_keep(const std::vector<std::string>& header, const Vertex_attributes& attributes) {
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

namespace equiaffine {

Vertex_attributes merge_attributes(Vertex_attributes first, const Vertex_attributes& second) {
  std::erase_if(first.columns, [&](const auto& old) {
    return std::any_of(second.columns.begin(), second.columns.end(), [&](const auto& c) { return c.name == old.name; });
  });
  first.columns.insert(first.columns.end(), second.columns.begin(), second.columns.end());
  if (second.status) first.status = second.status;
  const auto name = [](const std::string& comment) { return comment.substr(0, comment.find(':')); };
  std::erase_if(first.comments, [&](const auto& old) {
    return std::any_of(second.comments.begin(), second.comments.end(),
                       [&](const auto& c) { return name(c) == name(old); });
  });
  first.comments.insert(first.comments.end(), second.comments.begin(), second.comments.end());
  return first;
}

} // namespace equiaffine
