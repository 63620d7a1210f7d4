// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_XYZ_H
#define EQUIAFFINE_IO_READ_XYZ_H

#include <equiaffine/io/Annotated_mesh_3.h>
#include <equiaffine/io/internal/shared/fail_to_read.h>
#include <equiaffine/io/internal/text_input.h>
#include <equiaffine/io/internal/xyz_line.h>

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// Reads points as lines of x y z, or of x y z nx ny nz, with blanks between the numbers. Normals become columns. Empty
/// lines are left out. `name` stands for the file in messages. Throws `Input_error` for another line.
template <class Kernel>
Annotated_mesh_3<Kernel> read_XYZ(std::istream& stream, const std::string& name) {
  const std::string text = internal::read_all(stream);
  Annotated_mesh_3<Kernel> result;
  auto& columns = result.attributes.columns;
  std::size_t line_number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view line = internal::take_line(rest, line_number);
    const std::string where = "line " + std::to_string(line_number);
    const std::vector<double> numbers = internal::numbers_of_line(line, where, name);
    if (numbers.empty()) continue;
    if (result.mesh.points.empty() && numbers.size() == 6)
      for (const char* normal : {"nx", "ny", "nz"}) columns.push_back({normal, {}});
    if (numbers.size() != 3 + columns.size())
      internal::fail_to_read(name, where + " has " + std::to_string(numbers.size()) + " numbers",
                             "write x y z in every line, or x y z nx ny nz in every line");
    result.mesh.points.emplace_back(numbers[0], numbers[1], numbers[2]);
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c].values.push_back(numbers[3 + c]);
  }
  return result;
}

} // namespace equiaffine

#endif
