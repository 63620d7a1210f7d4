// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/Part_writer.h"

#include "system/files.h"
#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/io/internal/Ply_writer.h>
#include <equiaffine/io/write_CSV.h>
#include <equiaffine/io/write_mesh.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace equiaffine {

namespace {

/// The length of bytes in base64 (RFC 4648, section 4).
std::size_t length_of_base64(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

/// Appends bytes as base64, padded to a multiple of three bytes.
void append_base64(std::string_view bytes, std::string& text) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::size_t place = text.size(), n = 0;
  text.resize(place + length_of_base64(bytes.size()), '=');
  const auto byte = [&](std::size_t i) { return std::uint32_t(static_cast<unsigned char>(bytes[i])); };
  for (; n + 3 <= bytes.size(); n += 3, place += 4) {
    const std::uint32_t group = byte(n) << 16 | byte(n + 1) << 8 | byte(n + 2);
    for (std::size_t digit = 0; digit < 4; ++digit) text[place + digit] = digits[group >> (18 - 6 * digit) & 63];
  }
  if (n == bytes.size()) return;
  const bool has_two = bytes.size() - n == 2;
  const std::uint32_t group = byte(n) << 16 | (has_two ? byte(n + 1) << 8 : 0);
  for (std::size_t digit = 0; digit < (has_two ? 3 : 2); ++digit)
    text[place + digit] = digits[group >> (18 - 6 * digit) & 63];
}

/// The bytes of a number, least significant first.
template <class Number>
std::array<char, sizeof(Number)> little_endian(Number number) {
  std::array<char, sizeof(Number)> bytes;
  std::memcpy(bytes.data(), &number, sizeof number);
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// Escapes a name for an XML attribute.
std::string xml_text(std::string_view name) {
  std::string text;
  for (const char c : printable(std::string(name)))
    if (c == '&') text += "&amp;";
    else if (c == '<') text += "&lt;";
    else if (c == '>') text += "&gt;";
    else if (c == '"') text += "&quot;";
    else text += c;
  return text;
}

using Length = std::uint64_t; ///< of an array in bytes, written before it

constexpr std::size_t numbers_at_once = 6144; ///< a multiple of three

} // namespace

Vtp_writer::Vtp_writer(std::ostream& stream, std::size_t vertices, std::size_t faces, const Vertex_attributes& layout)
    : stream_(stream), vertices_left_(vertices), columns_(layout.columns.size()),
      has_status_(layout.status.has_value()) {
  text_ = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
          std::to_string(vertices) +
          "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(faces) +
          "\">\n<PointData>\n";
  for (const auto& column : layout.columns) begin_array("Float64", column.name, vertices, sizeof(double), 1);
  if (has_status_) begin_array("UInt8", "status", vertices, 1, 1);
  text_ += "</PointData>\n<CellData>\n</CellData>\n<Points>\n";
  begin_array("Float64", "Points", 3 * vertices, sizeof(double), 3);
  text_ += "</Points>\n<Polys>\n";
  const bool is_large = 3 * faces > std::size_t(std::numeric_limits<std::int32_t>::max());
  const char* const index = is_large ? "Int64" : "Int32";
  const std::size_t size_of_index = is_large ? sizeof(std::int64_t) : sizeof(std::int32_t);
  begin_array(index, "connectivity", 3 * faces, size_of_index, 1);
  begin_array(index, "offsets", faces, size_of_index, 1);
  text_ += "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  stream_.seekp(end_);
  stream_ << text_;
  if (vertices == 0) write_vertices({}, layout);
}

/// Writes the text before an array, and reserves space for the array.
void Vtp_writer::begin_array(std::string_view type, std::string_view name, std::size_t numbers,
                             std::size_t size_of_number, std::size_t components) {
  text_.append("<DataArray type=\"").append(type).append("\" Name=\"").append(xml_text(name));
  text_.append("\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"binary\">\n");
  stream_.seekp(end_);
  stream_ << text_;
  end_ += std::streamoff(text_.size());
  const std::size_t bytes = numbers * size_of_number;
  const auto length = little_endian(Length(bytes));
  arrays_.push_back({end_, std::string(length.begin(), length.end())});
  end_ += std::streamoff(length_of_base64(sizeof(Length) + bytes));
  text_ = "\n</DataArray>\n";
}

/// Writes the next bytes of an array.
void Vtp_writer::append(Array& array, std::string_view bytes, bool is_last) {
  array.rest.append(bytes);
  const std::size_t ready = is_last ? array.rest.size() : array.rest.size() / 3 * 3;
  std::string text;
  append_base64(std::string_view(array.rest).substr(0, ready), text);
  array.rest.erase(0, ready);
  stream_.write(text.data(), std::streamsize(text.size()));
  array.place += std::streamoff(text.size());
}

/// Writes the next numbers of an array, get(0) to get(count - 1).
template <class Number, class Get>
void Vtp_writer::append_numbers(Array& array, std::size_t count, bool is_last, const Get& get) {
  stream_.seekp(array.place);
  std::string bytes;
  std::size_t first = 0;
  do {
    Progress_observer::step();
    const std::size_t end = std::min(count, first + numbers_at_once);
    bytes.resize((end - first) * sizeof(Number));
    for (std::size_t n = first; n < end; ++n) {
      const auto of_number = little_endian(Number(get(n)));
      std::memcpy(&bytes[(n - first) * sizeof(Number)], of_number.data(), sizeof(Number));
    }
    append(array, bytes, is_last && end == count);
    first = end;
  } while (first < count);
}

void Vtp_writer::write_vertices(std::span<const Kernel::Point_3> points, const Vertex_attributes& attributes) {
  CGAL_precondition(points.size() <= vertices_left_);
  CGAL_precondition(points.empty() || attributes.has_length(points.size()));
  vertices_left_ -= points.size();
  const bool is_last = vertices_left_ == 0;
  for (std::size_t c = 0; c < columns_; ++c)
    append_numbers<double>(arrays_[c], points.size(), is_last,
                           [&](std::size_t n) { return attributes.columns[c].values[n]; });
  if (has_status_)
    append_numbers<std::uint8_t>(arrays_[columns_], points.size(), is_last,
                                 [&](std::size_t n) { return (*attributes.status)[n]; });
  append_numbers<double>(arrays_[columns_ + has_status_], 3 * points.size(), is_last,
                         [&](std::size_t n) { return points[n / 3][int(n % 3)]; });
}

template <class Index>
void Vtp_writer::write_faces_as(std::span<const std::array<std::uint32_t, 3>> faces) {
  append_numbers<Index>(arrays_.end()[-2], 3 * faces.size(), true, [&](std::size_t n) { return faces[n / 3][n % 3]; });
  append_numbers<Index>(arrays_.end()[-1], faces.size(), true, [&](std::size_t n) { return 3 * (n + 1); });
}

void Vtp_writer::write_faces(const std::vector<std::array<std::uint32_t, 3>>& faces) {
  if (3 * faces.size() > std::size_t(std::numeric_limits<std::int32_t>::max())) write_faces_as<std::int64_t>(faces);
  else write_faces_as<std::int32_t>(faces);
}

namespace {

bool is_VTP_file(const std::string& path) { return file_format(path) == File_format::VTP; }

class Ply_parts : public Part_writer {
public:
  Ply_parts(std::ostream& stream, std::size_t vertices, std::size_t faces, const Vertex_attributes& layout)
      : writer_(stream, vertices, faces, layout) {}
  void write_vertices(std::span<const Kernel::Point_3> points, const Vertex_attributes& attributes) override {
    writer_.write_vertices(points, attributes);
  }
  void write_faces(const std::vector<std::array<std::uint32_t, 3>>& faces) override {
    writer_.write_faces(faces);
    writer_.flush();
  }

private:
  Ply_writer writer_;
};

class Csv_parts : public Part_writer {
public:
  Csv_parts(std::ostream& stream, const Vertex_attributes& layout) : writer_(stream, layout) {}
  void write_vertices(std::span<const Kernel::Point_3> points, const Vertex_attributes& attributes) override {
    writer_.write_points(points, attributes);
  }
  void write_faces(const std::vector<std::array<std::uint32_t, 3>>&) override {} // the format has none

private:
  Csv_writer writer_;
};

} // namespace

bool is_written_in_parts(const std::string& path) {
  const auto format = mesh_format(path);
  return format == Mesh_format::PLY || format == Mesh_format::CSV || is_VTP_file(path);
}

std::unique_ptr<Part_writer> part_writer(const std::string& path, std::ostream& stream, std::size_t vertices,
                                         std::size_t faces, const Vertex_attributes& layout) {
  if (is_VTP_file(path)) return std::make_unique<Vtp_writer>(stream, vertices, faces, layout);
  if (mesh_format(path) == Mesh_format::CSV) return std::make_unique<Csv_parts>(stream, layout);
  return std::make_unique<Ply_parts>(stream, vertices, faces, layout);
}

} // namespace equiaffine
