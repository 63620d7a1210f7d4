// SPDX-License-Identifier: GPL-3.0-or-later
// Writes text and binary numbers in large blocks.
#ifndef EQUIAFFINE_IO_INTERNAL_BUFFERED_OUTPUT_H
#define EQUIAFFINE_IO_INTERNAL_BUFFERED_OUTPUT_H

#include <equiaffine/base/internal/compiler.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>

// The functions without a body are compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// Writes text and little-endian binary numbers to a stream in large blocks. Text does not depend on the stream's
/// format or on any locale. Call `flush()` to write the last block.
class Buffered_output {
public:
  explicit Buffered_output(std::ostream& stream) : stream_(stream) { buffer_.reserve(2 * block_size); }

  Buffered_output& operator<<(std::string_view text) {
    buffer_.append(text);
    if (buffer_.size() >= block_size) flush();
    return *this;
  }

  Buffered_output& operator<<(char character) { return *this << std::string_view(&character, 1); }

  /// Writes a number with 17 significant digits, which preserve every double; `nan` and zero have no sign.
  Buffered_output& operator<<(double number);

  Buffered_output& operator<<(std::size_t number);

  /// Writes a large text directly, without buffering.
  void write_block(std::string_view text);

  template <class Number>
  void write_binary(Number number) {
    auto bytes = bit_cast<std::array<char, sizeof(Number)>>(number);
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    *this << std::string_view(bytes.data(), bytes.size());
  }

  void flush();

private:
  static constexpr std::size_t block_size = std::size_t(1) << 16;

  std::ostream& stream_;
  std::string buffer_;
};

/// The coordinates of a point as doubles.
template <class Point_3>
std::array<double, 3> coordinates(const Point_3& p) {
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

/// Writes a keyword and three numbers as a line.
void write_line(Buffered_output& out, std::string_view keyword, const std::array<double, 3>& numbers);

/// The unit normal of a triangle, or zero if it has none.
std::array<double, 3> unit_normal(const std::array<std::array<double, 3>, 3>& corners);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
