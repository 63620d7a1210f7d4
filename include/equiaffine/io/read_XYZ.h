// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_XYZ_H
#define EQUIAFFINE_IO_READ_XYZ_H

#include <equiaffine/base/internal/printable.h>
#include <equiaffine/io/internal/fail_to_read.h>
#include <equiaffine/io/internal/text_input.h>
#include <equiaffine/io/internal/xyz_line.h>
#include <equiaffine/mesh/Annotated_mesh_3.h>

#include <algorithm>
#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// Reads points as lines of x y z, or of x y z and three numbers, with blanks between the numbers. The three numbers are
/// normals, columns nx, ny, nz, if their lengths are 1 or nearly, else colors, columns red, green, blue, which a comment
/// of the result says. A first line such as `//X Y Z R G B`, as CloudCompare writes it, or `# x y z intensity` names any
/// columns. Other lines behind // or # and empty lines are left out. `name` stands for the file in messages. Throws
/// `Input_error` for another line, and for numbers that are neither normals nor colors.
template <class Kernel>
Annotated_mesh_3<Kernel> read_XYZ(std::istream& stream, const std::string& name) {
  const std::string text = internal::read_all(stream);
  Annotated_mesh_3<Kernel> result;
  auto& columns = result.attributes.columns;
  std::size_t line_number = 0;
  bool has_names = false;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view line = internal::take_line(rest, line_number);
    if (const auto comment = internal::xyz_comment(line)) {
      const auto names = internal::xyz_column_names(*comment);
      if (!names || has_names || !result.mesh.points.empty()) continue;
      has_names = true;
      for (const std::string& column : *names) {
        if (std::any_of(columns.begin(), columns.end(), [&](const auto& other) { return other.name == column; }))
          internal::fail_to_read(name, "two columns have the name '" + printable(column) + "'", "rename one of them");
        columns.push_back({column, {}});
      }
      continue;
    }
    const std::string where = "line " + std::to_string(line_number);
    const std::vector<double> numbers = internal::numbers_of_line(line, where, name);
    if (numbers.empty()) continue;
    if (result.mesh.points.empty() && !has_names && numbers.size() == 6) columns.resize(3);
    if (numbers.size() != 3 + columns.size())
      internal::fail_to_read(name, where + " has " + std::to_string(numbers.size()) + " numbers",
                             has_names ? "write as many as there are names in the first line"
                                       : "write x y z in every line, or x y z nx ny nz in every line, or name the "
                                         "columns in a first line such as //X Y Z R G B");
    result.mesh.points.emplace_back(numbers[0], numbers[1], numbers[2]);
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(numbers[3 + c]);
  }
  if (!has_names && !columns.empty()) internal::name_xyz_columns(result.attributes, name);
  return result;
}

} // namespace equiaffine

#endif
