// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_DISPLAY_HTML_TEXT_H
#define EQUIAFFINE_SRC_DISPLAY_HTML_TEXT_H

#include <CGAL/IO/Color.h>

#include <string>
#include <string_view>

namespace equiaffine::internal {

/// Text as it may stand in an element or an attribute of a page.
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

/// A JSON string that may also stand inside a `<script>` element.
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

/// A color as CSS writes it: #rrggbb.
inline std::string hexadecimal(const CGAL::IO::Color& color) {
  constexpr char digits[] = "0123456789abcdef";
  std::string result = "#";
  for (const unsigned byte : {color.red(), color.green(), color.blue()})
    result += {digits[byte >> 4], digits[byte & 15]};
  return result;
}

} // namespace equiaffine::internal

#endif
