// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_CLI_OPTION_VALUES_H
#define EQUIAFFINE_SRC_CLI_OPTION_VALUES_H

// Words of the command line to values. `option` stands for the place in messages; every function throws `Input_error`.

#include "system/kernel.h"

#include <CGAL/Aff_transformation_3.h>
#include <CGAL/Bbox_3.h>

#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace equiaffine {

using Words = std::vector<std::string>;

/// "option: reason; advice"
[[noreturn]] void fail_option(const std::string& option, const std::string& reason, const std::string& advice);

double parse_finite_number(const std::string& option, const std::string& word);

/// A whole number, at least `minimum`.
std::size_t parse_count(const std::string& option, const std::string& word, std::size_t minimum);

/// One or three counts of nodes.
std::array<std::size_t, 3> parse_resolution(const std::string& option, const Words& words);

/// XMIN XMAX YMIN YMAX ZMIN ZMAX
CGAL::Bbox_3 parse_box(const std::string& option, const Words& words);

/// Nine numbers, row by row, of a matrix that is not singular, rounding considered.
CGAL::Aff_transformation_3<Kernel> parse_transformation(const std::string& option, const Words& words);

/// name=value
std::pair<std::string, double> parse_constant(const std::string& option, const std::string& word);

/// The position of `word` in `choices`.
std::size_t parse_choice(const std::string& option, const std::string& word,
                         std::initializer_list<std::string_view> choices);

/// ", did you mean 'candidate'?" for the candidate with the fewest typing errors, if they are few; else nothing.
std::string suggestion(const std::string& word, const Words& candidates);

} // namespace equiaffine

#endif
