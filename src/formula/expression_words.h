// SPDX-License-Identifier: GPL-3.0-or-later
// The names and characters of the language of expressions, and the messages of parse errors.
#ifndef EQUIAFFINE_SRC_FORMULA_EXPRESSION_WORDS_H
#define EQUIAFFINE_SRC_FORMULA_EXPRESSION_WORDS_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/formula/internal/expression_tape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine::internal::expression {

/// A function of the language, with its minimal and maximal number of arguments.
struct Function {
  std::string_view name;
  Opcode opcode;
  std::size_t minimal_arguments = 1;
  std::size_t maximal_arguments = 1;
};

inline constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

inline constexpr std::array functions = {Function{"sqrt", Opcode::SQRT},
                                         Function{"cbrt", Opcode::CBRT},
                                         Function{"exp", Opcode::EXP},
                                         Function{"log", Opcode::LOG},
                                         Function{"sin", Opcode::SIN},
                                         Function{"cos", Opcode::COS},
                                         Function{"tan", Opcode::TAN},
                                         Function{"asin", Opcode::ASIN},
                                         Function{"acos", Opcode::ACOS},
                                         Function{"atan", Opcode::ATAN},
                                         Function{"atan2", Opcode::ATAN2, 2, 2},
                                         Function{"sinh", Opcode::SINH},
                                         Function{"cosh", Opcode::COSH},
                                         Function{"tanh", Opcode::TANH},
                                         Function{"abs", Opcode::ABS},
                                         Function{"min", Opcode::MIN, 2, any_number},
                                         Function{"max", Opcode::MAX, 2, any_number},
                                         Function{"hypot", Opcode::HYPOT, 2, 2},
                                         Function{"erf", Opcode::ERF},
                                         Function{"floor", Opcode::FLOOR},
                                         Function{"sign", Opcode::SIGN},
                                         Function{"fmod", Opcode::FMOD, 2, 2},
                                         Function{"pow", Opcode::POWER, 2, 2}};

inline constexpr std::array<std::string_view, number_of_variables> variables = {"x", "y", "z"};

inline constexpr std::array known_constants = {std::pair<std::string_view, double>("pi", std::numbers::pi),
                                               std::pair<std::string_view, double>("e", std::numbers::e)};

/// Non-ASCII characters and their replacements.
inline constexpr std::array foreign_signs = {std::pair<std::string_view, std::string_view>("\u00b2", "^2"),
                                             std::pair<std::string_view, std::string_view>("\u00b3", "^3"),
                                             std::pair<std::string_view, std::string_view>("\u2074", "^4"),
                                             std::pair<std::string_view, std::string_view>("\u03c0", "pi"),
                                             std::pair<std::string_view, std::string_view>("\u00b7", "*"),
                                             std::pair<std::string_view, std::string_view>("\u00d7", "*"),
                                             std::pair<std::string_view, std::string_view>("\u2212", "-"),
                                             std::pair<std::string_view, std::string_view>("\u221a", "sqrt(...)")};

inline const Function* find_function(std::string_view name) {
  for (const Function& f : functions)
    if (f.name == name) return &f;
  return nullptr;
}

/// Whether a name has a predefined meaning.
inline bool is_reserved(std::string_view name) {
  return find_function(name) || std::find(variables.begin(), variables.end(), name) != variables.end() ||
         std::any_of(known_constants.begin(), known_constants.end(), [&](const auto& c) { return c.first == name; });
}

// Unlike the functions of <cctype>, these do not depend on the locale.
inline bool is_digit(char c) { return '0' <= c && c <= '9'; }
inline bool is_letter(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_'; }
inline bool is_space(char c) { return c == ' ' || ('\t' <= c && c <= '\r'); }
inline bool is_printable(char c) { return ' ' <= c && c <= '~'; }

inline std::string concatenated(std::initializer_list<std::string_view> parts) {
  std::string result;
  for (const std::string_view part : parts) result += part;
  return result;
}

inline std::string shortened(std::string_view word) {
  constexpr std::size_t longest = 40;
  return concatenated({word.substr(0, longest), word.size() > longest ? "..." : ""});
}

// Not called `quoted`, since argument-dependent lookup would also find std::quoted.
inline std::string in_quotes(std::string_view word) { return concatenated({"'", shortened(word), "'"}); }

/// A character for a message: in quotes, or its code if it is not printable.
inline std::string character(char c) {
  if (is_printable(c)) return in_quotes({&c, 1});
  constexpr std::string_view digits = "0123456789ABCDEF";
  const unsigned code = static_cast<unsigned char>(c);
  return concatenated({code < 0x80 ? "control character," : "non-ASCII character,", " byte 0x",
                       digits.substr(code / 16, 1), digits.substr(code % 16, 1)});
}

/// The number of arguments of a function, for example "2 or more arguments".
inline std::string arity(const Function& f) {
  const bool is_open = f.maximal_arguments == any_number, is_single = f.maximal_arguments == 1;
  return concatenated(
      {std::to_string(f.minimal_arguments), is_open ? " or more" : "", " argument", is_single ? "" : "s"});
}

inline std::string function_names() {
  std::string names;
  for (const Function& f : functions) names += concatenated({names.empty() ? "" : " ", f.name});
  return names;
}

/// The text around a position, cut to about 100 columns, with a caret below the position. Characters that are not
/// printable ASCII are replaced, which keeps the caret in the right column and is safe on terminals.
inline std::string excerpt_at(std::string_view text, std::size_t position) {
  constexpr std::size_t width = 94, before = 60;
  const std::size_t last_start = text.size() - std::min(width, text.size());
  const std::size_t start = std::min(position - std::min(before, position), last_start);
  const std::string_view lead = start > 0 ? "..." : "", trail = text.size() - start > width ? "..." : "";
  std::string line(text.substr(start, width));
  for (char& c : line)
    if (!is_printable(c)) c = is_space(c) ? ' ' : '?';
  return concatenated({lead, line, trail, "\n", std::string(lead.size() + position - start, ' '), "^"});
}

inline std::string sentence_at(std::size_t position, std::string_view problem, std::string_view advice) {
  return concatenated({problem, " at column ", std::to_string(position + 1), " of the expression: ", advice});
}

[[noreturn]] inline void throw_error_at(std::string_view text, std::size_t position, std::string_view problem,
                                        std::string_view advice) {
  throw Input_error(sentence_at(position, problem, advice), excerpt_at(text, position));
}

/// The number of letters to insert, delete or replace to turn `b` into `a`, ignoring case (Levenshtein: Binary codes
/// capable of correcting deletions, insertions, and reversals, 1966).
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) != lower(b[j]));
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, replaced}));
    }
  }
  return row[b.size()];
}

/// Names in other languages, and the corresponding names here.
inline constexpr std::array foreign_names = {std::pair<std::string_view, std::string_view>("ln", "log"),
                                             std::pair<std::string_view, std::string_view>("arcsin", "asin"),
                                             std::pair<std::string_view, std::string_view>("arccos", "acos"),
                                             std::pair<std::string_view, std::string_view>("arctan", "atan"),
                                             std::pair<std::string_view, std::string_view>("sgn", "sign"),
                                             std::pair<std::string_view, std::string_view>("mod", "fmod")};
inline constexpr std::array foreign_logarithms = {
    std::pair<std::string_view, std::string_view>("log10", "log(...)/log(10)"),
    std::pair<std::string_view, std::string_view>("log2", "log(...)/log(2)")};

/// The known name that was probably intended, or an empty string. Of equally near names the first one is returned.
inline std::string near_name(std::string_view name, const std::map<std::string, double>& constants) {
  std::size_t best = name.size() / 3 + 1;
  std::string_view nearest;
  const auto consider = [&](std::string_view spelling, std::string_view meaning) {
    if (name.size() > spelling.size() + best) return; // that many letters would have to be deleted
    if (const std::size_t distance = edit_distance(name, spelling); distance < best) {
      best = distance;
      nearest = meaning;
    }
  };
  for (const auto& [spelling, meaning] : foreign_names) consider(spelling, meaning);
  for (const std::string_view variable : variables) consider(variable, variable);
  for (const auto& [known, value] : known_constants) consider(known, known);
  for (const Function& f : functions) consider(f.name, f.name);
  for (const auto& [known, value] : constants) consider(known, known);
  for (const auto& [spelling, meaning] : foreign_logarithms) consider(spelling, meaning);
  return std::string(nearest);
}

inline bool is_identifier(std::string_view name) {
  return !name.empty() && !is_digit(name[0]) &&
         std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

/// The text with non-printable characters replaced by question marks.
inline std::string in_ascii(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return !is_printable(c); }, '?');
  return text;
}

/// Throws Input_error if a constant has an invalid name or a value that is not finite.
inline void check_constants(const std::map<std::string, double>& constants) {
  for (const auto& [name, value] : constants) {
    if (!is_identifier(name))
      throw Input_error(concatenated({in_quotes(in_ascii(name)),
                                      " is not a valid name of a constant: use letters, digits and _, and do not start "
                                      "with a digit"}));
    if (is_reserved(name))
      throw Input_error(concatenated({"the name of constant ", in_quotes(name), " is reserved: choose another name"}));
    if (!std::isfinite(value))
      throw Input_error(concatenated({"constant ", in_quotes(name), " is not finite: set it to a finite value"}));
  }
}

} // namespace equiaffine::internal::expression

#endif
