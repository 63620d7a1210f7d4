// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_PART_WRITER_H
#define EQUIAFFINE_PROGRAM_OUTPUT_PART_WRITER_H

#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace equiaffine {

/// Writes a mesh part by part: all vertices with their attributes in any number of parts, then all faces.
class Part_writer {
public:
  virtual ~Part_writer() = default;
  virtual void write_vertices(std::span<const Kernel::Point_3> points, const Vertex_attributes& attributes) = 0;
  virtual void write_faces(const std::vector<std::array<std::uint32_t, 3>>& faces) = 0;
};

/// Whether the format of the file holds attributes and can be written part by part.
bool is_written_in_parts(const std::string& path);

/// A writer for such a file. `layout` has the names of the columns, and whether there is a status; what numbers it has
/// does not matter.
std::unique_ptr<Part_writer> part_writer(const std::string& path, std::ostream& stream, std::size_t vertices,
                                         std::size_t faces, const Vertex_attributes& layout);

} // namespace equiaffine

#endif
