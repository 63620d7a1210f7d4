// SPDX-License-Identifier: GPL-3.0-or-later
// Extracts lines, words, and numbers from text, for the readers of points and meshes.
#ifndef EQUIAFFINE_SRC_IO_TEXT_INPUT_H
#define EQUIAFFINE_SRC_IO_TEXT_INPUT_H

#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/base/internal/from_chars.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace equiaffine::internal {

/// The text without blanks and line ends at both ends.
inline std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
}

/// The whole text as a number; nothing if it is not one. Allows surrounding blanks and a leading '+'. Independent of
/// the locale.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  text = trim(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number number{};
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Removes the first line from `text`, returns it without its end, and increments `line_number`.
inline std::string_view take_line(std::string_view& text, std::size_t& line_number) {
  Progress_observer::step();
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++line_number;
  return line;
}

/// Removes the first word from `text` and returns it; empty if there is none.
inline std::string_view take_word(std::string_view& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) {
    text = {};
    return {};
  }
  const std::size_t end = text.find_first_of(" \t\r\n", begin);
  const std::string_view word = text.substr(begin, end == std::string_view::npos ? end : end - begin);
  text.remove_prefix(begin + word.size());
  return word;
}

} // namespace equiaffine::internal

#endif
