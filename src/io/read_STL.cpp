// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_input.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/io/internal/input_file.h>
#include <equiaffine/io/read_points.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace equiaffine::internal {

namespace {

using Corner = std::array<double, 3>;

constexpr std::size_t bytes_of_header = 84, bytes_of_triangle = 50; // of binary STL

std::uint32_t little_endian(const char* bytes) {
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i) word = word << 8 | static_cast<unsigned char>(bytes[i]);
  return word;
}

std::vector<Corner> corners_of_binary_STL(std::string_view text, std::size_t triangles) {
  std::vector<Corner> corners;
  corners.reserve(3 * triangles);
  for (std::size_t t = 0; t < triangles; ++t) {
    Progress_observer::step();
    constexpr std::size_t bytes_of_normal = 12;
    const char* place = text.data() + bytes_of_header + t * bytes_of_triangle + bytes_of_normal;
    for (int corner = 0; corner < 3; ++corner) {
      for (double& x : corners.emplace_back()) {
        x = std::bit_cast<float>(little_endian(place));
        place += 4;
      }
    }
  }
  return corners;
}

/// Splits the text of an STL file into words. Lines end with a line feed, a carriage return, or both.
class Stl_scanner {
public:
  Stl_scanner(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  /// The next word in lower case; empty at the end.
  std::string next_word() {
    Progress_observer::step();
    while (!rest_.empty() && blanks.find(rest_[0]) != std::string_view::npos) {
      if (rest_[0] == '\n' || (rest_[0] == '\r' && !rest_.substr(1).starts_with('\n'))) ++next_line_;
      rest_.remove_prefix(1);
    }
    std::string word(rest_.substr(0, rest_.find_first_of(blanks)));
    rest_.remove_prefix(word.size());
    if (!word.empty()) line_ = next_line_;
    std::transform(word.begin(), word.end(), word.begin(),
                   [](char c) { return 'A' <= c && c <= 'Z' ? char(c + 32) : c; });
    return word;
  }

  Corner next_corner() {
    Corner corner{};
    for (double& x : corner) {
      const std::optional<double> number = parse_number<double>(next_word());
      if (!number) fail("has a missing or unreadable coordinate");
      x = *number;
    }
    return corner;
  }

  void skip_line() { rest_.remove_prefix(std::min(rest_.size(), rest_.find_first_of("\r\n"))); }

  /// Fails with the line number of the last word.
  [[noreturn]] void fail(const std::string& reason) const {
    fail_to_read(name_, "line " + std::to_string(line_) + " " + reason, "correct the file or get it again");
  }

private:
  static constexpr std::string_view blanks = " \t\r\n\v\f";

  std::string_view rest_;
  const std::string& name_;
  std::size_t line_ = 1, next_line_ = 1; ///< of the last word, and of the rest
};

/// Reads each word `vertex` with the three numbers after it, and `endfacet` after every three of them. Names after
/// `solid` and `endsolid` extend to the end of their line. Ignores other words.
std::vector<Corner> corners_of_text_STL(std::string_view text, const std::string& name) {
  std::vector<Corner> corners;
  std::size_t corners_of_facets = 0;
  bool is_complete = false;
  Stl_scanner scanner(text, name);
  for (std::string word = scanner.next_word(); !word.empty(); word = scanner.next_word()) {
    if (word == "solid" || word == "endsolid") {
      is_complete = word == "endsolid";
      scanner.skip_line();
    } else if (word == "vertex") {
      corners.push_back(scanner.next_corner());
    } else if (word == "endfacet") {
      if (corners.size() != corners_of_facets + 3) scanner.fail("ends a facet that is not a triangle");
      corners_of_facets = corners.size();
    }
  }
  if (!is_complete || corners.size() != corners_of_facets)
    fail_to_read(name, "it ends before the word endsolid", "get the complete file again");
  return corners;
}

/// For each corner, the first corner with the same coordinates. Zeros of both signs are equal, and so are NaNs with
/// the same bits. Sorting takes the same time for all coordinates.
std::vector<std::size_t> first_of_same(const std::vector<Corner>& corners) {
  const auto bits = [&](std::size_t c) {
    const auto& [x, y, z] = corners[c];
    return std::array{std::bit_cast<std::uint64_t>(x + 0.0), std::bit_cast<std::uint64_t>(y + 0.0),
                      std::bit_cast<std::uint64_t>(z + 0.0)};
  };
  std::vector<std::size_t> order(corners.size()), first(corners.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto of_a = bits(a), of_b = bits(b);
    return of_a < of_b || (of_a == of_b && a < b);
  });
  for (std::size_t n = 0; n < order.size(); ++n)
    first[order[n]] = n > 0 && bits(order[n]) == bits(order[n - 1]) ? first[order[n - 1]] : order[n];
  return first;
}

std::vector<Corner> corners_of_STL(std::string_view text, const std::string& name) {
  const bool has_header = text.size() >= bytes_of_header;
  const std::uint32_t triangles = has_header ? little_endian(text.data() + 80) : 0;
  const std::uint64_t binary_size = bytes_of_header + std::uint64_t(triangles) * bytes_of_triangle;
  // Many binary files also begin with the word solid, but contain zero bytes in the triangle count or in padding.
  const std::string_view header = text.substr(0, bytes_of_header);
  if (binary_size != text.size() && header.find('\0') == std::string_view::npos) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3); // a byte order mark
    if (Stl_scanner(text, name).next_word() == "solid") return corners_of_text_STL(text, name);
  }
  if (!has_header) fail_to_read(name, "it is not an STL file", "get the complete file again");
  if (binary_size > text.size())
    fail_to_read(name, "it declares " + std::to_string(triangles) + " triangles but ends before the last one",
                 "get the complete file again");
  return corners_of_binary_STL(text, triangles);
}

} // namespace

void read_STL_elements(std::istream& stream, const std::string& name, const Mesh_receiver& receiver) {
  const std::vector<Corner> corners = corners_of_STL(read_all(stream), name);
  if (corners.size() > std::numeric_limits<std::uint32_t>::max())
    fail_to_read(name, "it has more corners of triangles than 32 bits can count", "split it");
  const std::vector<std::size_t> first = first_of_same(corners);
  std::vector<std::uint32_t> vertices(corners.size()), face;
  std::uint32_t count = 0;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (first[c] == c) {
      receiver.add_point(corners[c][0], corners[c][1], corners[c][2]);
      vertices[c] = count++;
    }
    face.push_back(vertices[first[c]]);
    if (face.size() == 3) {
      receiver.add_face(face);
      face.clear();
    }
  }
}

} // namespace equiaffine::internal
