// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_PRINTABLE_H
#define EQUIAFFINE_BASE_INTERNAL_PRINTABLE_H

#include <equiaffine/base/internal/check_flags.h>
#include <equiaffine/base/internal/utf8.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace equiaffine {

/// The text as it may go to a terminal, in one line. Line ends and tabs become spaces. Bytes of control characters, of
/// characters that change the direction of writing, and bytes that are not UTF-8 become `\x` and two digits.
inline std::string printable(std::string_view text) {
  constexpr const char* digits = "0123456789abcdef";
  std::string result;
  while (!text.empty()) {
    const auto [code, bytes] = internal::first_character(text);
    const std::size_t taken = bytes == 0 ? 1 : bytes;
    if (bytes == 1 && (code == '\n' || code == '\r' || code == '\t')) result += ' ';
    else if (bytes > 0 && internal::is_harmless(code)) result += text.substr(0, bytes);
    else
      for (const char c : text.substr(0, taken)) {
        const auto byte = static_cast<unsigned char>(c);
        result += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
      }
    text.remove_prefix(taken);
  }
  return result;
}

} // namespace equiaffine

#endif
