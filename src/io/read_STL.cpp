// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_input.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>

#include <boost/container_hash/hash.hpp>

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
#include <unordered_map>
#include <vector>

namespace equiaffine::internal {

namespace {

constexpr std::size_t bytes_of_header = 84, bytes_of_triangle = 50; // of binary STL

/// Gives the corners of triangles on, those with the same coordinates as one point.
class Corner_receiver {
public:
  Corner_receiver(const Mesh_receiver& receiver, const std::string& name) : receiver_(receiver), name_(name) {}

  void add_corner(const std::array<double, 3>& p) {
    const auto [found, is_new] = points_.try_emplace(p, std::uint32_t(points_.size()));
    if (is_new) {
      if (points_.size() > std::numeric_limits<std::uint32_t>::max())
        fail_to_read(name_, "it has more vertices than 32 bits can count", "split it");
      receiver_.add_point(p[0], p[1], p[2]);
    }
    face_.push_back(found->second);
  }

  std::size_t number_of_corners() const { return face_.size(); }

  void end_triangle() {
    receiver_.add_face(face_);
    face_.clear();
  }

private:
  const Mesh_receiver& receiver_;
  const std::string& name_;
  std::unordered_map<std::array<double, 3>, std::uint32_t, boost::hash<std::array<double, 3>>> points_ = {};
  std::vector<std::uint32_t> face_ = {};
};

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i) word = word << 8 | static_cast<unsigned char>(bytes[i]);
  return word;
}

/// The number of triangles that the header of a binary file announces; nothing if the text is shorter than a header.
std::optional<std::size_t> announced_triangles(std::string_view text) {
  if (text.size() < bytes_of_header) return std::nullopt;
  return little_endian(text.data() + 80);
}

void read_binary_STL(std::string_view text, std::size_t triangles, Corner_receiver& corners) {
  for (std::size_t t = 0; t < triangles; ++t) {
    Progress_observer::step();
    constexpr std::size_t bytes_of_normal = 12;
    const char* place = text.data() + bytes_of_header + t * bytes_of_triangle + bytes_of_normal;
    for (int corner = 0; corner < 3; ++corner) {
      std::array<double, 3> p{};
      for (double& x : p) {
        x = std::bit_cast<float>(little_endian(place));
        place += 4;
      }
      corners.add_corner(p);
    }
    corners.end_triangle();
  }
}

/// Reads text: the words `vertex` with three numbers, and `endfacet` behind three of them; other words are left out.
void read_text_STL(std::string_view rest, const std::string& name, Corner_receiver& corners) {
  std::size_t line_number = 0;
  const auto fail = [&](const std::string& reason) {
    fail_to_read(name, "line " + std::to_string(line_number) + " " + reason, "correct the file or get it again");
  };
  bool is_complete = false;
  while (!rest.empty()) {
    std::string_view line = take_line(rest, line_number);
    for (std::string word(take_word(line)); !word.empty(); word = take_word(line)) {
      std::transform(word.begin(), word.end(), word.begin(),
                     [](char c) { return 'A' <= c && c <= 'Z' ? char(c + 32) : c; });
      if (word == "solid" || word == "endsolid") {
        is_complete = word == "endsolid";
        break; // a name follows
      }
      if (word == "vertex") {
        std::array<double, 3> p{};
        for (double& x : p) {
          const std::optional<double> number = parse_number<double>(take_word(line));
          if (!number) fail("has a missing or unreadable coordinate");
          x = *number;
        }
        corners.add_corner(p);
      } else if (word == "endfacet") {
        if (corners.number_of_corners() != 3) fail("ends a facet that is no triangle");
        corners.end_triangle();
      }
    }
  }
  if (!is_complete || corners.number_of_corners() > 0)
    fail_to_read(name, "it ends before the word endsolid", "get the complete file again");
}

} // namespace

void read_STL_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver) {
  const std::string text = read_all(stream);
  Corner_receiver corners(receiver, name);
  // Many binary files begin with the word solid, too, so that the size of the file decides.
  const std::optional<std::size_t> triangles = announced_triangles(text);
  const std::size_t binary_size = triangles ? bytes_of_header + *triangles * bytes_of_triangle : 0;
  if (triangles && binary_size == text.size()) return read_binary_STL(text, *triangles, corners);
  std::string_view begin = std::string_view(text).substr(0, 1000);
  if (take_word(begin) == "solid") return read_text_STL(text, name, corners);
  if (!triangles || binary_size > text.size())
    fail_to_read(name,
                 triangles ? "it announces " + std::to_string(*triangles) + " triangles and ends before the last one"
                           : "it is no STL file",
                 "get the complete file again");
  read_binary_STL(text, *triangles, corners);
}

} // namespace equiaffine::internal
