// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_XYZ_H
#define EQUIAFFINE_IO_READ_XYZ_H

#include <equiaffine/io/internal/mesh_readers.h>
#include <equiaffine/mesh/Annotated_mesh_3.h>

#include <istream>
#include <string>

namespace equiaffine {

/// Reads points as lines of x y z, or of x y z and three numbers, with blanks between the numbers. The three numbers are
/// normals, columns nx, ny, nz, if their lengths are 1 or nearly, else colors, columns red, green, blue, which a comment
/// of the result says. A first line such as `//X Y Z R G B`, as CloudCompare writes it, or `# x y z intensity` names any
/// columns. Other lines behind // or # and empty lines are left out. `name` stands for the file in messages. Throws
/// `Input_error` for another line, and for numbers that are neither normals nor colors.
template <class Kernel>
Annotated_mesh_3<Kernel> read_XYZ(std::istream& stream, const std::string& name) {
  Annotated_mesh_3<Kernel> result;
  result.attributes = internal::read_XYZ_elements(stream, name, internal::receiver_of(result.mesh));
  return result;
}

} // namespace equiaffine

#endif
