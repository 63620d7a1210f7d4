// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_PLY_H
#define EQUIAFFINE_IO_READ_PLY_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/text_input.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

/// A mesh, or points alone, with the numbers that came with the points.
template <class Kernel>
struct Annotated_mesh_3 {
  Indexed_triangle_mesh_3<Kernel> mesh;
  Vertex_attributes attributes;
};

namespace internal {

enum class Ply_type { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT, DOUBLE };

struct Ply_property {
  std::string name;
  Ply_type type;
  std::optional<Ply_type> count_type; ///< that of the length of a list
};

struct Ply_element {
  std::string name;
  std::size_t count;
  std::vector<Ply_property> properties;
};

/// The text of a PLY file, read from its beginning to its end; every number comes out as a double, which holds each of
/// PLY's types exactly.
class Ply_scanner {
public:
  Ply_scanner(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  [[noreturn]] void fail(const std::string& reason, const std::string& advice) const {
    throw Input_error("cannot read '" + name_ + "': " + reason + "; " + advice);
  }

  [[noreturn]] void fail_header(const std::string& reason) const {
    fail(reason + " in line " + std::to_string(line_number_) + " of its PLY header", "correct the header");
  }

  std::vector<Ply_element> header() {
    if (take_line(rest_, line_number_) != "ply") fail("it is not a PLY file", "check the path");
    std::vector<Ply_element> elements;
    bool has_format = false;
    while (true) {
      if (rest_.empty()) fail("it ends within its PLY header", "get the complete file again");
      std::string_view line = take_line(rest_, line_number_);
      const std::string_view keyword = take_word(line);
      if (keyword == "end_header") break;
      if (keyword == "format") {
        read_format(take_word(line));
        has_format = true;
      } else if (keyword == "element") {
        const std::string element_name(take_word(line));
        const auto count = parse_number<std::size_t>(line);
        if (!count) fail_header("the number of '" + element_name + "' is not understood");
        elements.push_back({element_name, *count, {}});
      } else if (keyword == "property") {
        if (elements.empty()) fail_header("a property before the first element");
        elements.back().properties.push_back(read_property(line));
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info")
        fail_header("the word '" + std::string(keyword) + "'");
    }
    if (!has_format) fail_header("no format");
    return elements;
  }

  double number(Ply_type type) {
    if (is_ascii_) {
      const std::string_view word = take_word(rest_);
      if (word.empty()) fail_at_end();
      const std::optional<double> value = parse_number<double>(word);
      if (!value) fail(std::string("'").append(word).append("' is not a number"), "correct the file");
      return *value;
    }
    switch (type) {
    case Ply_type::INT8: return binary<std::int8_t>();
    case Ply_type::UINT8: return binary<std::uint8_t>();
    case Ply_type::INT16: return binary<std::int16_t>();
    case Ply_type::UINT16: return binary<std::uint16_t>();
    case Ply_type::INT32: return binary<std::int32_t>();
    case Ply_type::UINT32: return binary<std::uint32_t>();
    case Ply_type::FLOAT: return double(binary<float>());
    default: return binary<double>();
    }
  }

  void list(const Ply_property& property, std::vector<double>& numbers) {
    const double count = number(*property.count_type);
    if (!(count >= 0 && count <= double(rest_.size()))) fail_at_end();
    numbers.clear();
    for (double i = 0; i < count; ++i) numbers.push_back(number(property.type));
  }

  /// Fails early, before memory is taken, if the rest cannot hold what the header announces.
  void check_length(const Ply_element& element) const {
    if (!element.properties.empty() && element.count > rest_.size()) fail_at_end();
  }

private:
  [[noreturn]] void fail_at_end() const {
    fail("it ends before all the numbers that its header announces", "get the complete file again");
  }

  void read_format(std::string_view format) {
    is_ascii_ = format == "ascii";
    is_big_endian_ = format == "binary_big_endian";
    if (!is_ascii_ && !is_big_endian_ && format != "binary_little_endian")
      fail_header("the format '" + std::string(format) + "'");
  }

  Ply_property read_property(std::string_view line) const {
    std::string_view type = take_word(line);
    std::optional<Ply_type> count_type;
    if (type == "list") {
      count_type = read_type(take_word(line));
      type = take_word(line);
    }
    const Ply_type number_type = read_type(type);
    return {std::string(trim(line)), number_type, count_type};
  }

  Ply_type read_type(std::string_view word) const {
    constexpr std::array<std::array<std::string_view, 2>, 8> words = {{{"char", "int8"},
                                                                       {"uchar", "uint8"},
                                                                       {"short", "int16"},
                                                                       {"ushort", "uint16"},
                                                                       {"int", "int32"},
                                                                       {"uint", "uint32"},
                                                                       {"float", "float32"},
                                                                       {"double", "float64"}}};
    for (std::size_t i = 0; i < words.size(); ++i)
      if (word == words[i][0] || word == words[i][1]) return static_cast<Ply_type>(i);
    fail_header("the type '" + std::string(word) + "'");
  }

  template <class Number>
  Number binary() {
    std::array<char, sizeof(Number)> bytes;
    if (rest_.size() < bytes.size()) fail_at_end();
    std::copy_n(rest_.begin(), bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    if (is_big_endian_ != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<Number>(bytes);
  }

  std::string_view rest_;
  const std::string& name_;
  std::size_t line_number_ = 0;
  bool is_ascii_ = false;
  bool is_big_endian_ = false;
};

/// Moves a column `status` of small integers to where it belongs.
inline void extract_status(Vertex_attributes& attributes) {
  const auto column = std::find_if(attributes.columns.begin(), attributes.columns.end(),
                                   [](const auto& c) { return c.name == "status"; });
  if (column == attributes.columns.end()) return;
  std::vector<Point_status> status;
  status.reserve(column->values.size());
  for (const double value : column->values) {
    if (!(value >= 0 && value < double(number_of_point_statuses))) return;
    status.push_back(static_cast<Point_status>(value));
  }
  attributes.status = std::move(status);
  attributes.columns.erase(column);
}

template <class Kernel>
void read_vertices(Ply_scanner& scanner, const Ply_element& element, Annotated_mesh_3<Kernel>& result) {
  std::array<std::optional<std::size_t>, 3> coordinates;
  std::vector<std::optional<std::size_t>> columns(element.properties.size());
  bool has_status = false;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Ply_property& property = element.properties[i];
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (property.count_type) continue;
    if (property.name.size() == 1 && axis != std::string_view::npos) {
      coordinates[axis] = i;
      continue;
    }
    columns[i] = result.attributes.columns.size();
    result.attributes.columns.push_back({property.name, {}});
    has_status = has_status || (property.name == "status" && property.type == Ply_type::UINT8);
  }
  if (!coordinates[0] || !coordinates[1] || !coordinates[2])
    scanner.fail("its vertices have no x, y and z", "write them to the file");

  for (auto& column : result.attributes.columns) column.values.reserve(element.count);
  result.mesh.points.reserve(element.count);
  std::vector<double> row(element.properties.size()), list;
  for (std::size_t v = 0; v < element.count; ++v) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (element.properties[i].count_type) scanner.list(element.properties[i], list);
      else row[i] = scanner.number(element.properties[i].type);
      if (columns[i]) result.attributes.columns[*columns[i]].values.push_back(row[i]);
    }
    result.mesh.points.emplace_back(row[*coordinates[0]], row[*coordinates[1]], row[*coordinates[2]]);
  }
  if (has_status) extract_status(result.attributes);
}

template <class Kernel>
void read_faces(Ply_scanner& scanner, const Ply_element& element, Indexed_triangle_mesh_3<Kernel>& mesh) {
  std::vector<double> list;
  std::vector<std::uint32_t> face;
  for (std::size_t f = 0; f < element.count; ++f)
    for (const Ply_property& property : element.properties) {
      if (!property.count_type) {
        scanner.number(property.type);
        continue;
      }
      scanner.list(property, list);
      if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
      face.clear();
      for (const double index : list) {
        if (!(index >= 0 && index < double(mesh.points.size())))
          scanner.fail("face " + std::to_string(f) + " has a vertex that does not exist", "correct the file");
        face.push_back(static_cast<std::uint32_t>(index));
      }
      add_face(mesh, face);
    }
}

} // namespace internal

/// Reads PLY (text or binary): the points, every other scalar property of the vertices as a column, `uchar status` as
/// the status, and the faces, if any, as fans of triangles. Lists at vertices and other elements are left out. `name`
/// stands for the file in messages. Throws `Input_error` for what is not a complete PLY file.
template <class Kernel>
Annotated_mesh_3<Kernel> read_PLY(std::istream& stream, const std::string& name) {
  const std::string text = internal::read_all(stream);
  internal::Ply_scanner scanner(text, name);
  Annotated_mesh_3<Kernel> result;
  std::vector<double> list;
  bool has_vertices = false;
  for (const internal::Ply_element& element : scanner.header()) {
    scanner.check_length(element);
    if (element.name == "vertex") {
      if (element.count > std::numeric_limits<std::uint32_t>::max()) scanner.fail("it has too many points", "split it");
      internal::read_vertices(scanner, element, result);
      has_vertices = true;
    } else if (element.name == "face") internal::read_faces(scanner, element, result.mesh);
    else
      for (std::size_t i = 0; i < element.count; ++i)
        for (const internal::Ply_property& property : element.properties)
          property.count_type ? scanner.list(property, list) : void(scanner.number(property.type));
  }
  if (!has_vertices) scanner.fail("it has no vertices", "check the path");
  return result;
}

} // namespace equiaffine

#endif
