// SPDX-License-Identifier: GPL-3.0-or-later
// A PLY file consists of a header, which specifies the encoding and lists elements with their properties, and of the
// numbers. Elements become points with columns, and faces.
#include "io/text_input.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/base/internal/compiler.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>
#include <equiaffine/mesh/Indexed_triangle_mesh_3.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine::internal {

namespace {

enum class Ply_encoding { ASCII, BINARY_LITTLE_ENDIAN, BINARY_BIG_ENDIAN };

enum class Ply_type { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT, DOUBLE };

struct Ply_property {
  std::string name;
  Ply_type type;
  std::optional<Ply_type> count_type; ///< the type of the length of a list; none for a single number
};

struct Ply_element {
  std::string name;
  std::size_t count;
  std::vector<Ply_property> properties;
};

struct Ply_header {
  Ply_encoding encoding;
  std::vector<Ply_element> elements;
  std::vector<std::string> comments; ///< except the one that names this program
};

/// Parses the header of a PLY file line by line.
class Ply_header_parser {
public:
  /// Parsing removes the header from `text`; `name` is the name of the file in messages.
  Ply_header_parser(std::string_view& text, const std::string& name) : text_(text), name_(name) {}

  Ply_header parse() {
    if (take_line(text_, line_number_) != "ply") fail_to_read(name_, "it is not a PLY file", "check the path");
    std::optional<Ply_encoding> encoding;
    std::vector<Ply_element> elements;
    std::vector<std::string> comments;
    while (true) {
      if (text_.empty()) fail_to_read(name_, "it ends within its PLY header", "get the complete file again");
      std::string_view line = take_line(text_, line_number_);
      const std::string_view keyword = take_word(line);
      if (keyword == "end_header") break;
      if (keyword == "format") encoding = parse_encoding(take_word(line));
      else if (keyword == "element") {
        Ply_element element = parse_element(line);
        if (std::any_of(elements.begin(), elements.end(), [&](const auto& e) { return e.name == element.name; }))
          fail("a second element '" + element.name + "'");
        elements.push_back(std::move(element));
      } else if (keyword == "property") {
        if (elements.empty()) fail("a property before the first element");
        Ply_property property = parse_property(line);
        auto& properties = elements.back().properties;
        if (properties.size() == most_properties)
          fail("more than " + std::to_string(most_properties) + " properties of an element");
        if (std::any_of(properties.begin(), properties.end(), [&](const auto& p) { return p.name == property.name; }))
          fail("a second property '" + property.name + "'");
        properties.push_back(std::move(property));
      } else if (keyword == "comment") {
        if (!trim(line).starts_with("made by equiaffine")) comments.emplace_back(trim(line));
      } else if (!keyword.empty() && keyword != "obj_info") fail("unknown word '" + std::string(keyword) + "'");
    }
    if (!encoding) fail("no format");
    return {*encoding, std::move(elements), std::move(comments)};
  }

private:
  static constexpr std::size_t most_properties = 10000;

  [[noreturn]] void fail(const std::string& what) const {
    fail_to_read(name_, what + " in line " + std::to_string(line_number_) + " of its PLY header", "correct the header");
  }

  Ply_encoding parse_encoding(std::string_view word) const {
    if (word == "ascii") return Ply_encoding::ASCII;
    if (word == "binary_little_endian") return Ply_encoding::BINARY_LITTLE_ENDIAN;
    if (word == "binary_big_endian") return Ply_encoding::BINARY_BIG_ENDIAN;
    fail("unknown format '" + std::string(word) + "'");
  }

  /// Parses the rest of the line after `element`: a name and a number.
  Ply_element parse_element(std::string_view line) const {
    const std::string element_name(take_word(line));
    const auto count = parse_number<std::size_t>(line);
    if (!count) fail("unreadable number of '" + element_name + "' elements");
    return {element_name, *count, {}};
  }

  /// Parses the rest of the line after `property`: a type, or `list` with two types, and a name.
  Ply_property parse_property(std::string_view line) const {
    std::string_view type = take_word(line);
    std::optional<Ply_type> count_type;
    if (type == "list") {
      count_type = parse_type(take_word(line));
      type = take_word(line);
    }
    const Ply_type number_type = parse_type(type);
    return {std::string(trim(line)), number_type, count_type};
  }

  Ply_type parse_type(std::string_view word) const {
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
    fail("unknown type '" + std::string(word) + "'");
  }

  std::string_view& text_;
  const std::string& name_;
  std::size_t line_number_ = 0;
};

/// Reads the numbers after the header of a PLY file in order. Each is returned as a double, which represents all
/// types of PLY exactly.
class Ply_numbers {
public:
  Ply_numbers(std::string_view text, Ply_encoding encoding, const std::string& name)
      : rest_(text), encoding_(encoding), name_(name) {}

  [[noreturn]] void fail(const std::string& reason, const std::string& advice) const {
    fail_to_read(name_, reason, advice);
  }

  /// Fails before any allocation if the rest of the file cannot hold the declared number of elements.
  void check_length(const Ply_element& element) const {
    if (!element.properties.empty() && element.count > rest_.size()) fail_at_end();
  }

  double next(Ply_type type) {
    if (encoding_ == Ply_encoding::ASCII) return next_word();
    switch (type) {
    case Ply_type::INT8: return next_binary<std::int8_t>();
    case Ply_type::UINT8: return next_binary<std::uint8_t>();
    case Ply_type::INT16: return next_binary<std::int16_t>();
    case Ply_type::UINT16: return next_binary<std::uint16_t>();
    case Ply_type::INT32: return next_binary<std::int32_t>();
    case Ply_type::UINT32: return next_binary<std::uint32_t>();
    case Ply_type::FLOAT: return double(next_binary<float>());
    default: return next_binary<double>();
    }
  }

  /// Reads the numbers of a list property into `list`.
  void next_list(const Ply_property& property, std::vector<double>& list) {
    const double count = next(*property.count_type);
    if (!(count >= 0 && count <= double(rest_.size()))) fail_at_end();
    list.clear();
    for (double i = 0; i < count; ++i) list.push_back(next(property.type));
  }

  /// Skips all elements of a kind that is not used.
  void skip(const Ply_element& element) {
    std::vector<double> list;
    for (std::size_t i = 0; i < element.count; ++i)
      for (const Ply_property& property : element.properties)
        if (property.count_type) next_list(property, list);
        else next(property.type);
  }

private:
  [[noreturn]] void fail_at_end() const {
    fail("it ends before all the numbers that its header declares", "get the complete file again");
  }

  double next_word() {
    const std::string_view word = take_word(rest_);
    if (word.empty()) fail_at_end();
    const std::optional<double> value = parse_number<double>(word);
    if (!value) fail(std::string("'").append(word).append("' is not a number"), "correct the file");
    return *value;
  }

  template <class Number>
  Number next_binary() {
    std::array<char, sizeof(Number)> bytes;
    if (rest_.size() < bytes.size()) fail_at_end();
    std::copy_n(rest_.begin(), bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    const bool is_big_endian = encoding_ == Ply_encoding::BINARY_BIG_ENDIAN;
    if (is_big_endian != (std::endian::native == std::endian::big)) std::reverse(bytes.begin(), bytes.end());
    return bit_cast<Number>(bytes);
  }

  std::string_view rest_;
  Ply_encoding encoding_;
  const std::string& name_;
};

/// How each property of a vertex is used.
struct Ply_vertex_layout {
  std::array<std::optional<std::size_t>, 3> coordinates; ///< the properties that are x, y, and z
  std::vector<std::optional<std::size_t>> columns; ///< the column of each property; none for coordinates and lists
  bool has_status = false;                         ///< whether a property is `uchar status`
};

/// Finds the coordinates, and appends an empty column to `attributes` for each other property that is a number.
Ply_vertex_layout lay_out_vertices(const Ply_element& element, Vertex_attributes& attributes) {
  Ply_vertex_layout layout;
  layout.columns.resize(element.properties.size());
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Ply_property& property = element.properties[i];
    if (property.count_type) continue;
    const std::size_t axis = std::string_view("xyz").find(property.name);
    if (property.name.size() == 1 && axis != std::string_view::npos) {
      layout.coordinates[axis] = i;
      continue;
    }
    layout.columns[i] = attributes.columns.size();
    attributes.columns.push_back({property.name, {}});
    layout.has_status = layout.has_status || (property.name == "status" && property.type == Ply_type::UINT8);
  }
  return layout;
}

/// Converts a column `status` to the status of the points, unless some of its numbers are not valid.
void extract_status(Vertex_attributes& attributes) {
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

void read_vertices(Ply_numbers& numbers, const Ply_element& element, const Mesh_receiver& receiver,
                   Vertex_attributes& attributes) {
  if (element.count > std::numeric_limits<std::uint32_t>::max()) numbers.fail("it has too many points", "split it");
  auto& columns = attributes.columns;
  const Ply_vertex_layout layout = lay_out_vertices(element, attributes);
  const auto& [x, y, z] = layout.coordinates;
  if (!x || !y || !z) numbers.fail("its vertices have no x, y and z", "write them to the file");

  for (auto& column : columns) column.values.reserve(element.count);
  receiver.reserve(element.count, 0);
  std::vector<double> row(element.properties.size()), list;
  for (std::size_t v = 0; v < element.count; ++v) {
    Progress_observer::step();
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (element.properties[i].count_type) numbers.next_list(element.properties[i], list);
      else row[i] = numbers.next(element.properties[i].type);
      if (layout.columns[i]) columns[*layout.columns[i]].values.push_back(row[i]);
    }
    receiver.add_point(row[*x], row[*y], row[*z]);
  }
  if (layout.has_status) extract_status(attributes);
}

/// Reads the faces; `points` is the number of points.
void read_faces(Ply_numbers& numbers, const Ply_element& element, std::size_t points, const Mesh_receiver& receiver) {
  std::vector<double> list;
  std::vector<std::uint32_t> face;
  for (std::size_t f = 0; f < element.count; ++f) {
    Progress_observer::step();
    for (const Ply_property& property : element.properties) {
      if (!property.count_type) {
        numbers.next(property.type);
        continue;
      }
      numbers.next_list(property, list);
      if (property.name != "vertex_indices" && property.name != "vertex_index") continue;
      face.clear();
      for (const double index : list) {
        if (!(index >= 0 && index < double(points) && index == std::floor(index)))
          numbers.fail("face " + std::to_string(f) + " has a vertex that does not exist", "correct the file");
        face.push_back(static_cast<std::uint32_t>(index));
      }
      receiver.add_face(face);
    }
  }
}

/// Reads the elements in the order of the header. Ignores those that are neither vertices nor faces.
Vertex_attributes read_elements(Ply_numbers& numbers, const std::vector<Ply_element>& elements,
                                const Mesh_receiver& receiver) {
  Vertex_attributes attributes;
  std::optional<std::size_t> points;
  for (const Ply_element& element : elements) {
    if (element.properties.empty() && element.name != "vertex") continue; // takes no bytes: any count is valid
    numbers.check_length(element);
    if (element.name == "vertex") {
      read_vertices(numbers, element, receiver, attributes);
      points = element.count;
    } else if (element.name == "face") read_faces(numbers, element, points.value_or(0), receiver);
    else numbers.skip(element);
  }
  if (!points) numbers.fail("it has no vertices", "check the path");
  return attributes;
}

} // namespace

Vertex_attributes read_PLY_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver) {
  const std::string text = read_all(stream);
  std::string_view rest = text;
  const Ply_header header = Ply_header_parser(rest, name).parse();
  Ply_numbers numbers(rest, header.encoding, name);
  Vertex_attributes attributes = read_elements(numbers, header.elements, receiver);
  attributes.comments = header.comments;
  return attributes;
}

} // namespace equiaffine::internal
