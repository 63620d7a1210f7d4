// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_input.h"
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine::internal {

namespace {

/// The position after a keyword that ends with OFF at the beginning of a text; 0 if there is none. The first number
/// may follow without a blank, as in many files of ModelNet.
std::size_t end_of_OFF_keyword(std::string_view text) {
  constexpr std::string_view keyword = "OFF";
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
  const std::size_t at = word.find(keyword);
  if (at == std::string_view::npos) return 0;
  const std::size_t end = at + keyword.size();
  return word.find_first_not_of("0123456789", end) == std::string_view::npos ? end : 0;
}

/// Splits the text of an OFF file into lines, without comments and blank lines.
class Off_scanner {
public:
  Off_scanner(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  /// Reads the keyword `OFF`, whose prefixes specify additional data of vertices, and the numbers of vertices and
  /// faces.
  std::array<std::size_t, 2> read_header() {
    if (trim(rest_).empty()) fail_to_read(name_, "it is empty", "give an OFF file");
    std::string_view text = next_line();
    if (const std::size_t end = end_of_OFF_keyword(text); end > 0) {
      if (text.substr(0, end).find_first_of("4n") != std::string_view::npos) fail("declares points that are not in 3D");
      text.remove_prefix(end);
      if (trim(text).empty()) text = next_line();
    }
    const auto vertices = parse_number<std::size_t>(take_word(text)),
               faces = parse_number<std::size_t>(take_word(text));
    if (!vertices || !faces) fail("does not contain the numbers of vertices and faces as text");
    if (*vertices > rest_.size() || *faces > rest_.size() || *vertices > std::numeric_limits<std::uint32_t>::max())
      fail("declares more vertices and faces than the file contains");
    return {*vertices, *faces};
  }

  /// Reads the coordinates of a vertex. Normals and colors after them are ignored.
  std::array<double, 3> read_vertex() {
    std::string_view text = next_line();
    std::array<double, 3> p{};
    for (double& x : p) x = number<double>(text);
    return p;
  }

  /// Reads a face into `face`. Its vertices must be less than `vertices`.
  void read_face(std::size_t vertices, std::vector<std::uint32_t>& face) {
    std::string_view text = next_line();
    face.clear();
    for (auto count = number<std::uint32_t>(text); count > 0; --count) {
      face.push_back(number<std::uint32_t>(text));
      if (face.back() >= vertices) fail("has a vertex that does not exist");
    }
  }

private:
  /// Takes the next number from a line.
  template <class Number>
  Number number(std::string_view& line) const {
    const std::optional<Number> value = parse_number<Number>(take_word(line));
    if (!value) fail("has a missing or unreadable number");
    return *value;
  }

  /// Fails with the number of the last line.
  [[noreturn]] void fail(const std::string& reason) const {
    fail_to_read(name_, "line " + std::to_string(line_number_) + " " + reason, "correct the file or get it again");
  }

  /// Takes the next nonempty line.
  std::string_view next_line() {
    while (!rest_.empty()) {
      std::string_view line = take_line(rest_, line_number_);
      line = trim(line.substr(0, line.find('#')));
      if (!line.empty()) return line;
    }
    fail("is the last one, but more lines are needed");
  }

  std::string_view rest_;
  const std::string& name_;
  std::size_t line_number_ = 0;
};

} // namespace

void read_OFF_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver) {
  const std::string text = read_all(stream);
  Off_scanner scanner(text, name);
  const auto [vertices, faces] = scanner.read_header();
  receiver.reserve(vertices, faces);
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto [x, y, z] = scanner.read_vertex();
    receiver.add_point(x, y, z);
  }
  std::vector<std::uint32_t> face;
  for (std::size_t f = 0; f < faces; ++f) {
    scanner.read_face(vertices, face);
    receiver.add_face(face);
  }
}

const char* extension_of_text(std::string_view text) {
  const std::string_view word = take_word(text);
  return word == "ply" ? ".ply" : end_of_OFF_keyword(word) > 0 ? ".off" : ".csv";
}

} // namespace equiaffine::internal
