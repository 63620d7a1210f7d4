// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_READ_OFF_H
#define EQUIAFFINE_IO_READ_OFF_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/io/text_input.h>
#include <equiaffine/surface/Indexed_triangle_mesh_3.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine {

namespace internal {

/// The lines of an OFF file that hold something, without comments.
class Off_scanner {
public:
  Off_scanner(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  [[noreturn]] void fail(const std::string& reason) const {
    throw Input_error("cannot read '" + name_ + "': line " + std::to_string(line_number_) + " " + reason +
                      "; correct the file or get it again");
  }

  std::string_view line() {
    while (!rest_.empty()) {
      std::string_view line = take_line(rest_, line_number_);
      line = trim(line.substr(0, line.find('#')));
      if (!line.empty()) return line;
    }
    fail("is the last one, but more has to follow");
  }

  /// The numbers of vertices and faces, after the keyword `OFF` with prefixes for what vertices have besides points.
  std::array<std::size_t, 2> header() {
    if (trim(rest_).empty()) throw Input_error("cannot read '" + name_ + "': it is empty; give an OFF file");
    std::string_view text = line();
    std::string_view after_keyword = text;
    const std::string_view keyword = take_word(after_keyword);
    if (keyword.ends_with("OFF")) {
      if (keyword.find_first_of("4n") != std::string_view::npos) fail("announces points that are not in 3D");
      text = trim(after_keyword).empty() ? line() : after_keyword;
    }
    const auto vertices = parse_number<std::size_t>(take_word(text)),
               faces = parse_number<std::size_t>(take_word(text));
    if (!vertices || !faces) fail("has no numbers of vertices and faces as text");
    if (*vertices > rest_.size() || *faces > rest_.size() || *vertices > std::numeric_limits<std::uint32_t>::max())
      fail("announces more vertices and faces than the file holds");
    return {*vertices, *faces};
  }

  template <class Number>
  Number number(std::string_view& line) const {
    const std::optional<Number> value = parse_number<Number>(take_word(line));
    if (!value) fail("has a missing or unreadable number");
    return *value;
  }

private:
  std::string_view rest_;
  const std::string& name_;
  std::size_t line_number_ = 0;
};

} // namespace internal

/// Reads OFF as text, a line for each vertex and face: points and faces, the latter as fans of triangles. Normals and
/// colours are left out. `name` stands for the file in messages. Throws `Input_error` for what is not a complete file.
template <class Kernel>
Indexed_triangle_mesh_3<Kernel> read_OFF(std::istream& stream, const std::string& name) {
  const std::string text = internal::read_all(stream);
  internal::Off_scanner scanner(text, name);
  const auto [vertices, faces] = scanner.header();
  Indexed_triangle_mesh_3<Kernel> mesh;
  mesh.points.reserve(vertices);
  mesh.triangles.reserve(faces);
  for (std::size_t v = 0; v < vertices; ++v) {
    std::string_view line = scanner.line();
    const double x = scanner.template number<double>(line), y = scanner.template number<double>(line),
                 z = scanner.template number<double>(line);
    mesh.points.emplace_back(x, y, z);
  }
  std::vector<std::uint32_t> face;
  for (std::size_t f = 0; f < faces; ++f) {
    std::string_view line = scanner.line();
    face.clear();
    for (auto count = scanner.template number<std::uint32_t>(line); count > 0; --count) {
      face.push_back(scanner.template number<std::uint32_t>(line));
      if (face.back() >= vertices) scanner.fail("has a vertex that does not exist");
    }
    internal::add_face(mesh, face);
  }
  return mesh;
}

} // namespace equiaffine

#endif
