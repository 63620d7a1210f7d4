// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/option_values.h"

#include <equiaffine/base/Input_error.h>
#include <equiaffine/formula/Expression_3.h>
#include <equiaffine/io/internal/input_file.h>

#include <CGAL/determinant.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace equiaffine {

namespace {

constexpr const char* axis_names = "XYZ";

/// Reads the whole word as a number, independently of the locale.
template <class Number>
std::optional<Number> parse_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return number;
}

} // namespace

void fail_option(const std::string& option, const std::string& reason, const std::string& advice) {
  throw Input_error(option_text(option) + ": " + reason + "; " + advice);
}

bool is_number(const std::string& word) { return parse_number<double>(word).has_value(); }

double parse_finite_number(const std::string& option, const std::string& word) {
  if (const std::optional<double> number = parse_number<double>(word)) {
    if (!std::isfinite(*number)) fail_option(option, "'" + word + "' is not a finite number", "give a finite one");
    return *number;
  }
  if (front_end == Front_end::PYTHON) fail_option(option, "'" + word + "' is not a number", "give a number");
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  try {
    // The value is NaN if the expression depends on x, y or z.
    if (const double value = Expression_3(word)(unknown, unknown, unknown); std::isfinite(value)) return value;
  } catch (const Input_error&) {
  }
  fail_option(option, "'" + word + "' is not a number", "write for example 2, -.5, 1e-3 or 2*pi/3");
}

std::size_t parse_count(const std::string& option, const std::string& word, std::size_t minimum) {
  const std::optional<std::size_t> number = parse_number<std::size_t>(word);
  if (!number || *number < minimum)
    fail_option(option, "'" + word + "' is not a whole number of at least " + std::to_string(minimum),
                "give one, such as " + std::to_string(minimum < 2 ? 2 : std::max<std::size_t>(minimum, 64)));
  return *number;
}

std::size_t parse_bytes(const Option_words& option) {
  const std::string& word = option.word();
  const char unit = word.back(); // no word is empty
  const auto number = parse_number<double>(word.substr(0, word.size() - 1));
  constexpr double most = 1e18;
  const double bytes = number.value_or(0) * (unit == 'M' ? 1 << 20 : unit == 'G' ? 1 << 30 : 0);
  if (!(bytes >= 1 && bytes <= most))
    fail_option(option.name, "'" + word + "' is not an amount of memory",
                "write for example 700M or 2G, where M is 2^20 and G is 2^30 bytes");
  return std::size_t(bytes);
}

std::array<double, 3> parse_triple(const Option_words& option) {
  std::array<double, 3> result{};
  for (std::size_t a = 0; a < 3; ++a) result[a] = parse_finite_number(option.name, option.words[a]);
  return result;
}

std::array<std::size_t, 3> parse_resolution(const Option_words& option) {
  const auto& [name, words, type] = option;
  if (words.size() != 1 && words.size() != 3)
    fail_option(name, std::to_string(words.size()) + " numbers are given", "give 1, N, or 3, NX NY NZ");
  std::array<std::size_t, 3> resolution{};
  for (std::size_t a = 0; a < 3; ++a) resolution[a] = parse_count(name, words[words.size() == 3 ? a : 0], 2);
  return resolution;
}

CGAL::Bbox_3 parse_box(const Option_words& option) {
  const auto& [name, words, type] = option;
  std::array<double, 6> bounds{};
  for (std::size_t i = 0; i < 6; ++i) bounds[i] = parse_finite_number(name, words[i]);
  for (std::size_t a = 0; a < 3; ++a) {
    const std::string axis(1, axis_names[a]);
    if (!(bounds[2 * a] < bounds[2 * a + 1]))
      fail_option(name,
                  "the box is empty: " + axis + "MIN " + words[2 * a] + " is not less than " + axis + "MAX " +
                      words[2 * a + 1],
                  "give XMIN XMAX YMIN YMAX ZMIN ZMAX");
    if (!std::isfinite(bounds[2 * a + 1] - bounds[2 * a]))
      fail_option(name, "the box is too large: a side overflows double precision", "choose another unit");
  }
  return {bounds[0], bounds[2], bounds[4], bounds[1], bounds[3], bounds[5]};
}

CGAL::Aff_transformation_3<Kernel> parse_transformation(const Option_words& option) {
  const auto& [name, words, type] = option;
  if (words.size() != 9 && words.size() != 12)
    fail_option(name, std::to_string(words.size()) + " numbers are given",
                "give 9 (a matrix, row by row) or 12 (a matrix and a translation)");
  std::array<double, 9> m{}, n{};
  std::array<double, 3> t{};
  for (std::size_t i = 0; i < 9; ++i) m[i] = parse_finite_number(name, words[i]);
  for (std::size_t i = 9; i < words.size(); ++i) t[i - 9] = parse_finite_number(name, words[i]);
  for (std::size_t row = 0; row < 3; ++row) {
    const double norm = std::hypot(m[3 * row], m[3 * row + 1], m[3 * row + 2]);
    for (std::size_t i = 3 * row; i < 3 * row + 3; ++i) n[i] = norm > 0 ? m[i] / norm : 0;
  }
  // The determinant of the normalized rows is the volume that they span. If it is not larger than rounding errors, the
  // rows are coplanar.
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  if (!(std::abs(CGAL::determinant(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8])) > rounding))
    fail_option(name, "the matrix is singular", "give an invertible matrix, row by row");
  if (!std::isnormal(CGAL::determinant(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8])))
    fail_option(name, "the determinant overflows or underflows double precision", "choose another unit");
  return {m[0], m[1], m[2], t[0], m[3], m[4], m[5], t[1], m[6], m[7], m[8], t[2]};
}

std::pair<std::string, double> parse_constant(const std::string& option, const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos || equals == 0)
    fail_option(option, "'" + word + "' does not have the form NAME=VALUE", "write for example R=2");
  return {word.substr(0, equals), parse_finite_number(option + " " + word, word.substr(equals + 1))};
}

Words split(const std::string& text, char separator) {
  Words parts(1);
  for (const char c : text)
    if (c == separator) parts.emplace_back();
    else parts.back() += c;
  return parts;
}

std::size_t parse_choice(const Option_words& option, const Words& choices) {
  const auto choice = std::find(choices.begin(), choices.end(), option.word());
  if (choice == choices.end()) {
    std::string list;
    for (const std::string& c : choices) list.append(list.empty() ? "" : " or ").append(c);
    fail_option(option.name, "unknown value '" + option.word() + "'", "use " + list);
  }
  return std::size_t(choice - choices.begin());
}

bool parse_flag(const Option_words& option) { return parse_choice(option, Words{"true", "false"}) == 0; }

std::optional<std::string> formula_file(const std::string& word) {
  if (!word.starts_with('@')) return std::nullopt;
  return word.substr(1);
}

std::string read_formula(const std::string& path) {
  constexpr std::size_t most = 1'000'000; // bytes
  if (path.empty()) throw Input_error("--function: the file name after @ is missing; write --function @FILE");
  std::ifstream file = open_input(path);
  std::string text(most + 1, '\0');
  text.resize(std::size_t(file.read(text.data(), std::streamsize(text.size())).gcount()));
  if (text.size() > most)
    throw Input_error("cannot read '" + path + "': it has more than 1000000 bytes; give a file with one formula");
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3); // the byte order mark of editors
  std::erase(text, '\r');
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t'; }, ' ');
  text.erase(std::find_if(text.rbegin(), text.rend(), [](char c) { return c != ' '; }).base(), text.end());
  if (text.empty()) throw Input_error("cannot read '" + path + "': it is empty; write a formula into it");
  return text;
}

} // namespace equiaffine
