// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_WORDS_H
#define EQUIAFFINE_FORMULA_INTERNAL_EXPRESSION_WORDS_H

#include <equiaffine/formula/internal/expression_tape.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>

/// The names and characters of the language of expressions.
namespace equiaffine::internal::expression {

/// A function of the language, with its numbers of arguments.
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

/// Signs that are not ASCII, each with what to write instead.
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

/// Whether a name has a meaning in every expression.
inline bool is_reserved(std::string_view name) {
  return find_function(name) || std::find(variables.begin(), variables.end(), name) != variables.end() ||
         std::any_of(known_constants.begin(), known_constants.end(), [&](const auto& c) { return c.first == name; });
}

// The functions of <cctype> depend on the locale, and these must not.
inline bool is_digit(char c) { return '0' <= c && c <= '9'; }
inline bool is_letter(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_'; }
inline bool is_space(char c) { return c == ' ' || ('\t' <= c && c <= '\r'); }
inline bool is_printable(char c) { return ' ' <= c && c <= '~'; }

} // namespace equiaffine::internal::expression

#endif
