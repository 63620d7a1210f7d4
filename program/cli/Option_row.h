// SPDX-License-Identifier: GPL-3.0-or-later
// The table of options. A row says everything about one option, from its help to where its value goes. For a new option
// add a row to source_options.cpp, surface_options.cpp, map_options.cpp or output_options.cpp.
#ifndef EQUIAFFINE_PROGRAM_CLI_OPTION_ROW_H
#define EQUIAFFINE_PROGRAM_CLI_OPTION_ROW_H

#include "cli/Draft.h"
#include "cli/option_values.h"

#include <span>
#include <string>
#include <vector>

namespace equiaffine {

/// The commands of the program, as bits: an option of several commands has their sum.
enum Command : unsigned { MESH = 1, EVALUATE = 2, SAMPLE = 4, VIEW = 8, ANNOTATE = 16, REGISTER = 32, SYMMETRIES = 64 };
using Commands = unsigned;

/// The commands that look for maps.
inline constexpr Commands registering = REGISTER | SYMMETRIES;

/// Says below which heading of the help an option stands. The words of the heading depend on the command: title_of() in
/// command_line.cpp has them.
enum class Option_group { INPUT, SOURCE, BOX, FIT, SURFACE, SAMPLING, MARCHING_CUBES, DELAUNAY, REMESH, MAPS, OUTPUT };

/// Whether the options of the group belong to the source or to its surface. Others of `register`, which has two sources,
/// may stand on either side of the word `to`.
inline bool belongs_to_source(Option_group group) {
  return group != Option_group::MAPS && group != Option_group::OUTPUT;
}

/// How many words follow the name of an option.
struct Number_of_words {
  int least, most; ///< `most` is unlimited if it is 0 and `least` is not

  constexpr Number_of_words(int exactly) : least(exactly), most(exactly) {}
  constexpr Number_of_words(int at_least, int at_most) : least(at_least), most(at_most) {}
};

constexpr int unlimited = 0;

struct Option_row {
  std::string names; ///< such as "-o,--output"; a positional argument has a name without dashes
  Commands commands;
  Option_group group;
  Number_of_words words;
  std::string type; ///< how the help writes the words
  std::string help;
  /// Reads the words and puts their value into the draft. Throws `Input_error` if it cannot read them.
  void (*read)(const Option_words& option, Draft& draft);

  /// The last of the names, by which messages call the option.
  std::string name() const { return names.substr(names.find(',') + 1); }
};

/// The parts of the table, in the order of the help.
std::span<const Option_row> source_options();
std::span<const Option_row> surface_options();
std::span<const Option_row> map_options();
std::span<const Option_row> output_options();

/// The rows of a command in the order of its help.
std::vector<const Option_row*> options_of(Command command);

} // namespace equiaffine

#endif
