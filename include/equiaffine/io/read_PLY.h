// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_PLY_H
#define EQUIAFFINE_IO_READ_PLY_H

#include <equiaffine/io/Annotated_mesh_3.h>
#include <equiaffine/io/internal/Ply_header.h>
#include <equiaffine/io/internal/Ply_numbers.h>
#include <equiaffine/io/internal/ply_elements.h>
#include <equiaffine/io/internal/text_input.h>

#include <istream>
#include <string>
#include <string_view>

namespace equiaffine {

/// Reads PLY (text or binary): the points, every other scalar property of the vertices as a column, `uchar status` as
/// the status, the comments, and the faces, if any, cut into triangles. Lists at vertices and other elements are left
/// out. `name` stands for the file in messages. Throws `Input_error` for what is not a complete PLY file.
template <class Kernel>
Annotated_mesh_3<Kernel> read_PLY(std::istream& stream, const std::string& name) {
  const std::string text = internal::read_all(stream);
  std::string_view rest = text;
  const internal::Ply_header header = internal::Ply_header_parser(rest, name).parse();
  internal::Ply_numbers numbers(rest, header.encoding, name);
  Annotated_mesh_3<Kernel> result = internal::read_elements<Kernel>(numbers, header.elements);
  result.attributes.comments = header.comments;
  return result;
}

} // namespace equiaffine

#endif
