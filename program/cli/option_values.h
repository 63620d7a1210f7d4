// SPDX-License-Identifier: GPL-3.0-or-later
// Turns words of options into values. Every function throws `Input_error` with the name of the option.
#ifndef EQUIAFFINE_PROGRAM_CLI_OPTION_VALUES_H
#define EQUIAFFINE_PROGRAM_CLI_OPTION_VALUES_H

#include "system/front_end.h"
#include "system/kernel.h"
#include <equiaffine/base/Input_error.h>

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

using Words = std::vector<std::string>;

/// A given option: its name in C++, its words, and their type in the help.
struct Option_words {
  std::string name;
  Words words;
  std::string type;

  const std::string& word() const { return words.front(); }
};

/// "option: reason; advice", where `option` is the name in C++.
[[noreturn]] void fail_option(const std::string& option, const std::string& reason, const std::string& advice);

/// Checks an options struct. Throws its error with the name of the option instead of that of the field.
template <class Options>
void check_options(const Options& options) {
  try {
    options.check();
  } catch (const Input_error& error) {
    throw Input_error(option_text(error.field().substr(error.field().rfind('.') + 1)) + ": " + error.sentence());
  }
}

bool is_number(const std::string& word);

/// A finite number. The command line also accepts arithmetic, such as 2*pi/3.
double parse_finite_number(const std::string& option, const std::string& word);

/// The only word of the option as a number.
inline double parse_number(const Option_words& option) { return parse_finite_number(option.name, option.word()); }

/// The words of the option as numbers.
std::array<double, 3> parse_triple(const Option_words& option);

/// A whole number, at least `minimum`.
std::size_t parse_count(const std::string& option, const std::string& word, std::size_t minimum);

/// A number of bytes, such as 700M or 1.5G.
std::size_t parse_bytes(const Option_words& option);

/// One or three counts of nodes.
std::array<std::size_t, 3> parse_resolution(const Option_words& option);

/// XMIN XMAX YMIN YMAX ZMIN ZMAX
CGAL::Bbox_3 parse_box(const Option_words& option);

/// A matrix, row by row, that is not numerically singular, and optionally a translation: 9 or 12 numbers.
CGAL::Aff_transformation_3<Kernel> parse_transformation(const Option_words& option);

/// name=value, where the value is a number or arithmetic.
std::pair<std::string, double> parse_constant(const std::string& option, const std::string& word);

/// The parts of a text between separators.
Words split(const std::string& text, char separator);

/// The position of the only word of the option in `choices`.
std::size_t parse_choice(const Option_words& option, const Words& choices);

/// The value at the position of the word in the type of the option, such as "box|ball".
template <class Value>
Value parse_choice(const Option_words& option, std::initializer_list<Value> values) {
  return values.begin()[parse_choice(option, split(option.type, '|'))];
}

/// Whether an option without words is given.
bool parse_flag(const Option_words& option);

/// The path after the @ if the word of --function is `@FILE`, or nothing if it is a formula.
std::optional<std::string> formula_file(const std::string& word);

/// The formula in a file, with spaces for line breaks. Throws `Input_error` if the file cannot be read, is empty or is
/// too long for a formula.
std::string read_formula(const std::string& path);

} // namespace equiaffine

#endif
