// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_input.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <istream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine::internal {

namespace {

/// The numbers in a line. Fails if a word is not a number.
std::vector<double> numbers_of_line(std::string_view line, const std::string& where, const std::string& name) {
  std::vector<double> numbers;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
    const std::optional<double> number = parse_number<double>(word);
    if (!number) fail_to_read(name, where + ": '" + std::string(word) + "' is not a number", "correct it");
    numbers.push_back(*number);
  }
  return numbers;
}

/// The text of a comment line, after // or #; nothing for any other line.
std::optional<std::string_view> xyz_comment(std::string_view line) {
  line = trim(line);
  if (line.starts_with('#')) return line.substr(1);
  if (line.starts_with("//")) return line.substr(2);
  return std::nullopt;
}

/// The names of the columns after x, y, z if a comment is a list of names as written by CloudCompare, such as X Y Z R
/// G B. Normals are named nx, ny, nz, and colors red, green, blue, as in PLY.
std::optional<std::vector<std::string>> xyz_column_names(std::string_view comment) {
  constexpr std::string_view usual[][2] = {{"x", "x"},   {"y", "y"},   {"z", "z"},     {"nx", "nx"}, {"ny", "ny"},
                                           {"nz", "nz"}, {"r", "red"}, {"g", "green"}, {"b", "blue"}};
  std::vector<std::string> names;
  for (std::string_view word = take_word(comment); !word.empty(); word = take_word(comment)) {
    std::string name(word);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char c) { return 'A' <= c && c <= 'Z' ? char(c + 32) : c; });
    const auto* const found =
        std::find_if(std::begin(usual), std::end(usual), [&](const auto& pair) { return pair[0] == name; });
    names.emplace_back(found == std::end(usual) ? word : (*found)[1]);
  }
  if (names.size() < 3 || names[0] != "x" || names[1] != "y" || names[2] != "z") return std::nullopt;
  names.erase(names.begin(), names.begin() + 3);
  return names;
}

/// Decides whether three columns without names are normals or colors, and names them. They are normals if their
/// lengths are 1, up to rounding to two decimals, or 0 for missing ones. Fails if they are neither normals nor
/// colors.
void name_xyz_columns(Vertex_attributes& attributes, const std::string& name) {
  constexpr double rounding = 0.01, brightest = 65535;
  auto& columns = attributes.columns;
  bool has_normal = false, has_another = false, are_colors = true;
  for (std::size_t row = 0; row < columns[0].values.size(); ++row) {
    const double u = columns[0].values[row], v = columns[1].values[row], w = columns[2].values[row],
                 length = std::hypot(u, v, w);
    if (std::abs(length - 1) <= rounding) has_normal = true;
    else if (std::isfinite(length) && length > 0) has_another = true;
    are_colors = are_colors && std::min({u, v, w}) >= 0 && std::max({u, v, w}) <= brightest;
  }
  const bool are_normals = has_normal && !has_another;
  if (!are_normals && !are_colors)
    fail_to_read(name,
                 "its columns 4 to 6 are neither normals, which have length 1, nor colors, which are not negative",
                 "name them in a first line, such as //X Y Z Nx Ny Nz");
  constexpr const char* normals[] = {"nx", "ny", "nz"};
  constexpr const char* colors[] = {"red", "green", "blue"};
  for (std::size_t c = 0; c < 3; ++c) columns[c].name = are_normals ? normals[c] : colors[c];
  if (!are_normals) attributes.comments.emplace_back(xyz_colors_note);
}

} // namespace

Vertex_attributes read_XYZ_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver) {
  const std::string text = read_all(stream);
  Vertex_attributes attributes;
  auto& columns = attributes.columns;
  std::size_t line_number = 0, points = 0;
  bool has_names = false;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view line = take_line(rest, line_number);
    if (const auto comment = xyz_comment(line)) {
      const auto names = xyz_column_names(*comment);
      if (!names || has_names || points > 0) continue;
      has_names = true;
      for (const std::string& column : *names) {
        if (std::any_of(columns.begin(), columns.end(), [&](const auto& other) { return other.name == column; }))
          fail_to_read(name, "two columns have the name '" + printable(column) + "'", "rename one of them");
        columns.push_back({column, {}});
      }
      continue;
    }
    const std::string where = "line " + std::to_string(line_number);
    const std::vector<double> numbers = numbers_of_line(line, where, name);
    if (numbers.empty()) continue;
    if (points == 0 && !has_names && numbers.size() == 6) columns.resize(3);
    if (numbers.size() != 3 + columns.size())
      fail_to_read(name, where + " has " + std::to_string(numbers.size()) + " numbers",
                   has_names ? "write as many as there are names in the first line"
                             : "write x y z in every line, or x y z nx ny nz in every line, or name the "
                               "columns in a first line such as //X Y Z R G B");
    receiver.add_point(numbers[0], numbers[1], numbers[2]);
    ++points;
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(numbers[3 + c]);
  }
  if (!has_names && !columns.empty()) name_xyz_columns(attributes, name);
  return attributes;
}

} // namespace equiaffine::internal
