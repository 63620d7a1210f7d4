// SPDX-License-Identifier: GPL-3.0-or-later
// Writes meshes part by part, so that the attributes of a large mesh are never all in memory.
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_PART_WRITER_H
#define EQUIAFFINE_PROGRAM_OUTPUT_PART_WRITER_H

#include "system/kernel.h"
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>
#include <equiaffine/surface/parabolic_curves.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// Writes a mesh part by part: all vertices with their attributes in any number of parts, then all faces.
class Part_writer {
public:
  virtual ~Part_writer() = default;
  virtual void write_vertices(std::span<const Kernel::Point_3> points, const Vertex_attributes& attributes) = 0;
  virtual void write_faces(const std::vector<std::array<std::uint32_t, 3>>& faces) = 0;
};

/// Whether the format of the file has attributes and can be written part by part.
bool is_written_in_parts(const std::string& path);

/// A writer for such a file. `layout` has the names of the columns, and a status if there is one; its values are not
/// used.
std::unique_ptr<Part_writer> part_writer(const std::string& path, std::ostream& stream, std::size_t vertices,
                                         std::size_t faces, const Vertex_attributes& layout);

/// Writes a mesh as a VTK polydata file (VTK File Formats, "XML file formats"), part by part: points in double
/// precision, triangles, a double point array per column and, if there is a status, an unsigned char array `status`.
/// Arrays are not compressed, so that their positions are known in advance, and are inline base64: readers with a
/// recent expat lose appended arrays. Errors are in the state of the stream, which must be seekable.
class Vtp_writer : public Part_writer {
public:
  /// `layout` is as in part_writer().
  Vtp_writer(std::ostream& stream, std::size_t vertices, std::size_t faces, const Vertex_attributes& layout);

  void write_vertices(std::span<const Kernel::Point_3> points, const Vertex_attributes& attributes) override;
  void write_faces(const std::vector<std::array<std::uint32_t, 3>>& faces) override;

private:
  /// An array of the file, partly written.
  struct Array {
    std::streamoff place; ///< of the next text
    std::string rest;     ///< bytes that do not yet fill a group of three
  };

  void begin_array(std::string_view type, std::string_view name, std::size_t numbers, std::size_t size_of_number,
                   std::size_t components);
  void append(Array& array, std::string_view bytes, bool is_last);
  template <class Number, class Get>
  void append_numbers(Array& array, std::size_t count, bool is_last, const Get& get);
  template <class Index>
  void write_faces_as(std::span<const std::array<std::uint32_t, 3>> faces);

  std::ostream& stream_;
  std::string text_; ///< pending text before, between or after the arrays
  std::streamoff end_ = 0;
  std::vector<Array> arrays_; ///< the columns, the status if there is one, the points, and two for the faces
  std::size_t vertices_left_, columns_;
  bool has_status_;
};

/// Writes curves as a VTK polydata file: points in double precision, and a polyline for each curve; a closed one ends
/// with the index of its first point. Errors are in the state of the stream.
void write_VTP(std::ostream& stream, const Parabolic_curves_3<Kernel>& curves);

} // namespace equiaffine

#endif
