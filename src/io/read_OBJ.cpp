// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_input.h"
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine::internal {

namespace {

/// The OBJ statements that describe neither points nor faces.
constexpr std::string_view statements_to_skip[] = {
    "bevel", "bmat",   "bsp",       "bzp",      "c_interp", "call",   "cdc", "cdp",  "con", "csh",        "cstype",
    "ctech", "curv",   "curv2",     "d_interp", "deg",      "end",    "g",   "hole", "l",   "lod",        "maplib",
    "mg",    "mtllib", "o",         "p",        "parm",     "res",    "s",   "scrv", "sp",  "shadow_obj", "stech",
    "step",  "surf",   "trace_obj", "trim",     "usemap",   "usemtl", "vn",  "vp",   "vt"};

/// Reads the lines of an OBJ file.
class Obj_reader {
public:
  Obj_reader(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  void read(const Mesh_receiver& receiver) {
    while (!rest_.empty()) read_statement(receiver);
    if (number_of_points_ == 0) fail_to_read(name_, "it has no vertices", "give an OBJ file with vertices and faces");
    std::size_t begin = 0;
    std::vector<std::uint32_t> face;
    for (std::size_t f = 0; f < ends_.size(); ++f) {
      face.clear();
      for (; begin < ends_[f]; ++begin) {
        if (corners_[begin] >= number_of_points_)
          fail_to_read(name_, "its face " + std::to_string(f) + ", counted from 0, has a vertex that does not exist",
                       "get the complete file again");
        face.push_back(std::uint32_t(corners_[begin]));
      }
      receiver.add_face(face);
    }
  }

private:
  void read_statement(const Mesh_receiver& receiver) {
    std::string_view line = next_line();
    const std::string_view statement = take_word(line);
    if (statement == "v") {
      const double x = coordinate(line), y = coordinate(line), z = coordinate(line);
      if (++number_of_points_ > std::numeric_limits<std::uint32_t>::max())
        fail_to_read(name_, "it has more vertices than 32 bits can count", "split it");
      receiver.add_point(x, y, z);
    } else if (statement == "f") {
      for (std::string_view word = take_word(line); !word.empty(); word = take_word(line))
        corners_.push_back(position(word));
      ends_.push_back(corners_.size());
    } else if (!statement.empty() && std::find(std::begin(statements_to_skip), std::end(statements_to_skip),
                                               statement) == std::end(statements_to_skip)) {
      fail("begins with '" + std::string(statement) + "', which is not a statement of OBJ");
    }
  }

  double coordinate(std::string_view& line) const {
    const std::optional<double> x = parse_number<double>(take_word(line));
    if (!x) fail("has a missing or unreadable coordinate");
    return *x;
  }

  /// The index of the vertex of a corner VERTEX, VERTEX/TEXTURE, or VERTEX/TEXTURE/NORMAL of a face. Positive numbers
  /// count the vertices of the file from 1, negative ones count backward from the last vertex before the face.
  std::size_t position(std::string_view corner) const {
    const auto number = parse_number<std::int64_t>(corner.substr(0, corner.find('/')));
    if (!number) fail("has a face with a vertex that is not an integer");
    if (*number == 0 || *number < -std::int64_t(number_of_points_) ||
        *number > std::numeric_limits<std::uint32_t>::max())
      fail("has a face with a vertex that does not exist");
    return *number > 0 ? std::size_t(*number) - 1 : number_of_points_ - std::size_t(-*number);
  }

  /// Takes the next line without its comment. A vertex or a face that ends with a backslash continues in the next
  /// line.
  std::string_view next_line() {
    const auto next_part = [&] {
      const std::string_view line = take_line(rest_, line_number_);
      return line.substr(0, line.find('#'));
    };
    std::string_view line = next_part(), rest = line;
    const std::string_view statement = take_word(rest);
    if (!line.ends_with('\\') || (statement != "v" && statement != "f")) return line;
    joined_.clear();
    for (; line.ends_with('\\'); line = next_part()) joined_.append(line.substr(0, line.size() - 1)) += ' ';
    return joined_.append(line);
  }

  /// Fails with the number of the last line.
  [[noreturn]] void fail(const std::string& reason) const {
    fail_to_read(name_, "line " + std::to_string(line_number_) + " " + reason, "correct the file or get it again");
  }

  std::string_view rest_;
  const std::string& name_;
  std::string joined_ = {};
  std::size_t line_number_ = 0, number_of_points_ = 0;
  std::vector<std::size_t> corners_ = {}, ends_ = {}; ///< of all faces; a face may refer to later vertices
};

} // namespace

void read_OBJ_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver) {
  const std::string text = read_all(stream);
  Obj_reader(text, name).read(receiver);
}

} // namespace equiaffine::internal
