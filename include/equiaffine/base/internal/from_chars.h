// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_FROM_CHARS_H
#define EQUIAFFINE_BASE_INTERNAL_FROM_CHARS_H

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <locale.h>
#include <stdlib.h>
#include <string>
#include <string_view>
#include <system_error>
#include <version>

#ifdef __APPLE__
#include <xlocale.h>
#endif

namespace equiaffine::internal {

/// Finds the longest prefix of a text that std::from_chars accepts as a floating-point number.
class Number_text {
public:
  /// The length of that prefix; 0 if the text does not start with a number.
  static std::size_t length(std::string_view text) {
    Number_text number(text);
    number.skip("-");
    const std::size_t length = number.skip_word();
    return length > 0 ? length : number.skip_decimal();
  }

private:
  explicit Number_text(std::string_view text) : text_(text) {}

  /// Skips an infinity or a NaN at the current position. Returns the position after it, or 0 if there is none.
  std::size_t skip_word() {
    if (skip("infinity") || skip("inf")) return position_;
    if (!skip("nan")) return 0;
    const std::size_t end = position_;
    if (!skip("(")) return end;
    while (position_ < text_.size() && (is_digit() || is_letter(text_[position_]) || text_[position_] == '_'))
      ++position_;
    return skip(")") ? position_ : end;
  }

  /// Skips digits with an optional point and exponent. Returns the position after them, or 0 if there are none.
  std::size_t skip_decimal() {
    std::size_t digits = skip_digits();
    if (skip(".")) digits += skip_digits();
    if (digits == 0) return 0;
    const std::size_t end = position_;
    if (!skip("e")) return end;
    if (!skip("-")) skip("+");
    return skip_digits() > 0 ? position_ : end;
  }

  std::size_t skip_digits() {
    const std::size_t start = position_;
    while (is_digit()) ++position_;
    return position_ - start;
  }

  /// Skips a lower-case `word` at the current position, ignoring case. Returns whether it was there.
  bool skip(std::string_view word) {
    if (text_.size() - position_ < word.size()) return false;
    for (std::size_t i = 0; i < word.size(); ++i) {
      const char c = text_[position_ + i];
      if (c != word[i] && !(is_letter(c) && (c | 0x20) == word[i])) return false;
    }
    position_ += word.size();
    return true;
  }

  bool is_digit() const { return position_ < text_.size() && '0' <= text_[position_] && text_[position_] <= '9'; }
  static bool is_letter(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); }

  std::string_view text_;
  std::size_t position_ = 0;
};

/// Implements std::from_chars by the C library's strtod in the classic locale.
template <std::floating_point Number>
std::from_chars_result from_chars_by_strtod(const char* first, const char* last, Number& value) {
  static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
  const std::string text(first, Number_text::length(std::string_view(first, std::size_t(last - first))));
  if (text.empty()) return {first, std::errc::invalid_argument};
  const char* const end = first + text.size();
  Number number;
  if constexpr (std::same_as<Number, float>) number = strtof_l(text.c_str(), nullptr, classic);
  else if constexpr (std::same_as<Number, double>) number = strtod_l(text.c_str(), nullptr, classic);
  else number = strtold_l(text.c_str(), nullptr, classic);
  const std::string_view mantissa = std::string_view(text).substr(0, text.find_first_of("eE"));
  const bool is_decimal = mantissa.find_first_not_of("-.0123456789") == std::string_view::npos;
  const bool is_zero = mantissa.find_first_of("123456789") == std::string_view::npos;
  if (is_decimal && (std::isinf(number) || (number == 0 && !is_zero))) return {end, std::errc::result_out_of_range};
  value = number;
  return {end, std::errc()};
}

/// std::from_chars; some versions of libc++ provide it for integers only.
template <class Number>
std::from_chars_result from_chars(const char* first, const char* last, Number& value) {
#ifndef __cpp_lib_to_chars
  if constexpr (std::floating_point<Number>) return from_chars_by_strtod(first, last, value);
  else
#endif
    return std::from_chars(first, last, value);
}

} // namespace equiaffine::internal

#endif
