// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_IO_PLY_HEADER_H
#define EQUIAFFINE_SRC_IO_PLY_HEADER_H

#include "io/text_input.h"
#include <equiaffine/io/internal/input_file.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The header of a PLY file says how its numbers are written, and lists its elements with their properties.
namespace equiaffine::internal {

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
  std::vector<std::string> comments; ///< all but the one that names this program
};

/// Takes the header off the text of a PLY file, line by line.
class Ply_header_parser {
public:
  /// The parser moves the beginning of `text`; `name` stands for the file in messages.
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
      } else if (!keyword.empty() && keyword != "obj_info") fail("the word '" + std::string(keyword) + "'");
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
    fail("the format '" + std::string(word) + "'");
  }

  /// Parses what follows the word `element`: a name and a number.
  Ply_element parse_element(std::string_view line) const {
    const std::string element_name(take_word(line));
    const auto count = parse_number<std::size_t>(line);
    if (!count) fail("the number of '" + element_name + "' is not understood");
    return {element_name, *count, {}};
  }

  /// Parses what follows the word `property`: a type or `list` with two types, and a name.
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
    fail("the type '" + std::string(word) + "'");
  }

  std::string_view& text_;
  const std::string& name_;
  std::size_t line_number_ = 0;
};

} // namespace equiaffine::internal

#endif
