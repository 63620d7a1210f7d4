// SPDX-License-Identifier: GPL-3.0-or-later
// Encodes texts, colors, and bytes for a page.
#ifndef EQUIAFFINE_SRC_DISPLAY_PAGE_TEXT_H
#define EQUIAFFINE_SRC_DISPLAY_PAGE_TEXT_H

#include <CGAL/IO/Color.h>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>

namespace equiaffine::internal {

/// Text escaped for an element or an attribute of a page.
inline std::string html_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
    case '&': result += "&amp;"; break;
    case '<': result += "&lt;"; break;
    case '>': result += "&gt;"; break;
    case '"': result += "&quot;"; break;
    case '\'': result += "&#39;"; break;
    default: result += c;
    }
  }
  return result;
}

/// A JSON string that is also safe inside a `<script>` element.
inline std::string json_string(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || c == '"' || c == '\\' || c == '<')
      result += {'\\', 'u', '0', '0', digits[byte >> 4], digits[byte & 15]};
    else result += c;
  }
  return result + '"';
}

/// A color in CSS notation: #rrggbb.
inline std::string hexadecimal(const CGAL::IO::Color& color) {
  constexpr char digits[] = "0123456789abcdef";
  std::string result = "#";
  for (const unsigned byte : {color.red(), color.green(), color.blue()})
    result += {digits[byte >> 4], digits[byte & 15]};
  return result;
}

/// Writes bytes to a stream as base64 (RFC 4648, section 4, padded, without line breaks). Call `finish` once at the
/// end.
class Base64_writer {
public:
  explicit Base64_writer(std::ostream& out) : out_(out) { text_.reserve(buffer_size + 4); }

  void put(std::uint8_t byte) {
    group_ = (group_ << 8) | byte;
    if (++bytes_in_group_ == 3) put_group();
  }

  /// Writes the four bytes of a word, least significant byte first.
  void put_little_endian(std::uint32_t word) {
    for (int shift = 0; shift < 32; shift += 8) put(static_cast<std::uint8_t>(word >> shift));
  }

  void finish() {
    const int missing = (3 - bytes_in_group_) % 3;
    for (int i = 0; i < missing; ++i) put(0);
    text_.replace(text_.size() - static_cast<std::size_t>(missing), std::string::npos,
                  static_cast<std::size_t>(missing), '=');
    flush();
  }

private:
  static constexpr std::size_t buffer_size = 1 << 16;

  void put_group() {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (text_.size() >= buffer_size) flush();
    for (int shift = 18; shift >= 0; shift -= 6) text_ += digits[(group_ >> shift) & 63];
    group_ = 0;
    bytes_in_group_ = 0;
  }

  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

  std::ostream& out_;
  std::string text_;
  std::uint32_t group_ = 0;
  int bytes_in_group_ = 0;
};

} // namespace equiaffine::internal

#endif
