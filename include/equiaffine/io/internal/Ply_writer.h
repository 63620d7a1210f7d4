// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_PLY_WRITER_H
#define EQUIAFFINE_IO_INTERNAL_PLY_WRITER_H

#include <equiaffine/io/internal/buffered_output.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// The member function without a body is compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// Writes binary PLY in parts: the header, then all vertices in any number of parts, then all faces.
class Ply_writer {
public:
  /// Writes the header. Only the names of the columns in `layout` are used, whether it has a status, and its
  /// comments.
  Ply_writer(std::ostream& stream, std::size_t vertices, std::size_t faces, const Vertex_attributes& layout)
      : out_(stream) {
    write_header(vertices, faces, layout);
  }

  /// Writes the next vertices with their attributes, one row of numbers for each.
  template <class Point>
  void write_vertices(std::span<const Point> points, const Vertex_attributes& attributes) {
    CGAL_precondition(attributes.has_length(points.size()));
    constexpr std::size_t number = sizeof(double);
    const std::size_t columns = attributes.columns.size(), width = number * (3 + columns) + (attributes.status ? 1 : 0);
    for (std::size_t first = 0; first < points.size(); first += rows_at_once) {
      const std::size_t rows = std::min(rows_at_once, points.size() - first);
      block_.resize(rows * width);
      for (std::size_t row = 0; row < rows; ++row) {
        const std::array<double, 3> p = internal::coordinates(points[first + row]);
        for (std::size_t axis = 0; axis < 3; ++axis) store(p[axis], row * width + axis * number);
      }
      for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t row = 0; row < rows; ++row)
          store(attributes.columns[c].values[first + row], row * width + (3 + c) * number);
      for (std::size_t row = 0; row < rows && attributes.status; ++row)
        store(static_cast<std::uint8_t>((*attributes.status)[first + row]), (row + 1) * width - 1);
      out_.write_block(block_);
    }
  }

  /// Writes all faces, each a range of vertex indices.
  template <class Face>
  void write_faces(const std::vector<Face>& faces) {
    for (std::size_t first = 0; first < faces.size(); first += rows_at_once) {
      const auto rows = std::span(faces).subspan(first, std::min(rows_at_once, faces.size() - first));
      std::size_t size = 0;
      for (const Face& face : rows) size += 1 + sizeof(std::uint32_t) * face.size();
      block_.resize(size);
      std::size_t place = 0;
      for (const Face& face : rows) {
        store(static_cast<std::uint8_t>(face.size()), place++);
        for (const std::uint32_t v : face) {
          store(v, place);
          place += sizeof v;
        }
      }
      out_.write_block(block_);
    }
  }

  void flush() { out_.flush(); }

private:
  /// The number of rows per block; with their attributes they fit into the first-level cache.
  static constexpr std::size_t rows_at_once = 256;

  void write_header(std::size_t vertices, std::size_t faces, const Vertex_attributes& layout);

  /// Stores a number at a position of the block, least significant byte first.
  template <class Number>
  void store(Number number, std::size_t place) {
    char* const bytes = &block_[place];
    std::memcpy(bytes, &number, sizeof number);
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes, bytes + sizeof number);
  }

  internal::Buffered_output out_;
  std::string block_;
};

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
