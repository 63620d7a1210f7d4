// SPDX-License-Identifier: GPL-3.0-or-later
// Input_error, the exception for unusable texts and files, and functions that make its message safe for a terminal.
#ifndef EQUIAFFINE_BASE_INPUT_ERROR_H
#define EQUIAFFINE_BASE_INPUT_ERROR_H

#include <equiaffine/base/internal/compiler.h>

#include <array>
#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace equiaffine::internal {

/// A character and its length in bytes. The length is 0 if the bytes are not valid UTF-8.
struct Utf8_character {
  char32_t code = 0;
  std::size_t bytes = 0;
};

/// The length in bytes of a character whose first byte is `lead`, or 0 if no character starts with this byte.
inline std::size_t number_of_bytes(unsigned lead) {
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead < 0xE0) return 2;
  if (lead >= 0xE0 && lead < 0xF0) return 3;
  return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

inline Utf8_character first_character(std::string_view text) {
  const unsigned lead = static_cast<unsigned char>(text.front());
  const std::size_t bytes = number_of_bytes(lead);
  if (bytes == 1) return {lead, 1};
  if (bytes == 0 || bytes > text.size()) return {};
  char32_t code = lead & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    const unsigned next = static_cast<unsigned char>(text[i]);
    if (next >> 6 != 2) return {};
    code = code << 6 | (next & 0x3F);
  }
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code < 0xE000;
  return code < least[bytes] || code > 0x10FFFF || is_surrogate ? Utf8_character{} : Utf8_character{code, bytes};
}

/// Whether a terminal displays the character without side effects.
inline bool is_harmless(char32_t code) {
  const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  const bool breaks_lines = code == 0x2028 || code == 0x2029;
  const bool turns_direction =
      code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return !is_control && !breaks_lines && !turns_direction;
}

} // namespace equiaffine::internal

namespace equiaffine {

/// \cond for internal use
/// Returns the text as one line that is safe to print on a terminal. Line ends and tabs become spaces. Control
/// characters, characters that change the writing direction, and bytes that are not UTF-8 become `\x` and two digits
/// per byte.
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

/// Throws std::invalid_argument, in every build, if `is_valid` is false. Used for sizes, boxes and lengths that may
/// come from a user. `sentence` states what is wrong and what to do.
inline void check_argument(bool is_valid, const char* sentence) {
  if (!is_valid) throw std::invalid_argument(sentence);
}
/// \endcond

} // namespace equiaffine

// Programs must be able to catch what the shared library throws.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// The exception for a text or a file that cannot be used.
/// `what()` is one line: what is wrong, where, and what to do. Quoted parts of the text or file are `printable`.
/// `excerpt()` is the offending text with a caret below it, or empty.
/// `field()` is the invalid member of an options struct, such as "min_overlap" or "fit.scale", or empty. If it is set,
/// `what()` is the field, a colon and the `sentence()`, so that a front end can substitute its own name of the option.
class Input_error : public std::runtime_error {
public:
  /// Creates an error from its message and excerpt.
  explicit Input_error(const std::string& what, std::string excerpt = {})
      : std::runtime_error(printable(what)), excerpt_(std::move(excerpt)) {}

  /// Creates an error about a member of an options struct.
  static Input_error about(const std::string& field, const std::string& sentence) {
    Input_error error(field + ": " + sentence);
    error.field_ = field;
    return error;
  }

  const std::string& excerpt() const { return excerpt_; } ///< the offending text with a caret, or empty
  const std::string& field() const { return field_; }     ///< the invalid member of an options struct, or empty

  /// The message without the field.
  std::string sentence() const { return field_.empty() ? what() : std::string(what()).substr(field_.size() + 2); }

private:
  std::string excerpt_, field_;
};

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

namespace equiaffine::internal {

/// Throws if a number in a field of an options struct is invalid: "field: '1.5' is not between 0 and 1; advice".
inline void check_field(bool is_valid, const std::string& field, double number, const std::string& problem,
                        const std::string& advice) {
  if (is_valid) return;
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  throw Input_error::about(field, "'" + std::string(digits.data(), end) + "' " + problem + "; " + advice);
}

/// Checks options that are a member of other options. The field of an error becomes "member.field".
template <class Options>
void check_member(const std::string& member, const Options& options) {
  try {
    options.check();
  } catch (const Input_error& error) {
    throw Input_error::about(member + "." + error.field(), error.sentence());
  }
}

} // namespace equiaffine::internal

#endif
