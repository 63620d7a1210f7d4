// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_XYZ_LINE_H
#define EQUIAFFINE_IO_INTERNAL_XYZ_LINE_H

#include <equiaffine/io/internal/fail_to_read.h>
#include <equiaffine/io/internal/text_input.h>
#include <equiaffine/io/internal/xyz_colors_note.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine::internal {

/// The numbers in a line. Fails if there is a word that is none.
inline std::vector<double> numbers_of_line(std::string_view line, const std::string& where, const std::string& name) {
  std::vector<double> numbers;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
    const std::optional<double> number = parse_number<double>(word);
    if (!number) fail_to_read(name, where + ": '" + std::string(word) + "' is not a number", "correct it");
    numbers.push_back(*number);
  }
  return numbers;
}

/// The text of a line that is a comment, behind // or #; nothing for another one.
inline std::optional<std::string_view> xyz_comment(std::string_view line) {
  line = trim(line);
  if (line.starts_with('#')) return line.substr(1);
  if (line.starts_with("//")) return line.substr(2);
  return std::nullopt;
}

/// The names of the columns behind x, y, z, if a comment is a list of names as CloudCompare writes it, X Y Z R G B. Normals
/// are called nx, ny, nz, and colors red, green, blue, as in PLY.
inline std::optional<std::vector<std::string>> xyz_column_names(std::string_view comment) {
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

/// Tells what three columns without names are, and names them. They are normals if these have the length 1, as written
/// with two decimals or more; some may be missing, which is written as zeros. Otherwise they are colors. Fails if they
/// are neither.
inline void name_xyz_columns(Vertex_attributes& attributes, const std::string& name) {
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
                 "its columns 4 to 6 are neither normals, which have the length 1, nor colors, which are not negative",
                 "name them in a first line, such as //X Y Z Nx Ny Nz");
  constexpr const char* normals[] = {"nx", "ny", "nz"};
  constexpr const char* colors[] = {"red", "green", "blue"};
  for (std::size_t c = 0; c < 3; ++c) columns[c].name = are_normals ? normals[c] : colors[c];
  if (!are_normals) attributes.comments.emplace_back(xyz_colors_note);
}

} // namespace equiaffine::internal

#endif
