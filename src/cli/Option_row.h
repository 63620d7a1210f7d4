// SPDX-License-Identifier: GPL-3.0-or-later
// The table of options: one row says all of an option, from its help to where its value goes. A new option is a row in
// source_options.cpp, surface_options.cpp or output_options.cpp.
#ifndef EQUIAFFINE_SRC_CLI_OPTION_ROW_H
#define EQUIAFFINE_SRC_CLI_OPTION_ROW_H

#include "cli/Draft.h"
#include "cli/option_values.h"

#include <span>
#include <string>
#include <vector>

namespace equiaffine {

/// The commands of the program; the options of several are a sum.
enum Command : unsigned { MESH = 1, EVALUATE = 2, SAMPLE = 4, VIEW = 8 };
using Commands = unsigned;

/// The heading in the help below which an option stands. It depends on the command, see title_of().
enum class Option_group { INPUT, SOURCE, BOX, SURFACE, SAMPLING, MARCHING_CUBES, DELAUNAY, OUTPUT };

/// How many words follow the name of an option.
struct Number_of_words {
  int least, most; ///< `most` is unlimited if it is 0

  constexpr Number_of_words(int exactly) : least(exactly), most(exactly) {}
  constexpr Number_of_words(int at_least, int at_most) : least(at_least), most(at_most) {}
};

constexpr int unlimited = 0;

struct Option_row {
  std::string names; ///< such as "-o,--output"; a name without dashes is that of a positional
  Commands commands;
  Option_group group;
  Number_of_words words;
  std::string type; ///< how the help writes the words
  std::string help;
  /// Puts the value of the words into the draft. Throws `Input_error` for words that have none.
  void (*read)(const Option_words& option, Draft& draft);

  /// The last of its names, which stands for it in messages.
  std::string name() const { return names.substr(names.find(',') + 1); }
};

/// The parts of the table, in the order of the help.
std::span<const Option_row> source_options();
std::span<const Option_row> surface_options();
std::span<const Option_row> output_options();

/// The rows of a command in the order of its help.
std::vector<const Option_row*> options_of(Command command);

} // namespace equiaffine

#endif
