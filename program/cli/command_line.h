// SPDX-License-Identifier: GPL-3.0-or-later
// The table of options, and the words of a command line.
#ifndef EQUIAFFINE_PROGRAM_CLI_COMMAND_LINE_H
#define EQUIAFFINE_PROGRAM_CLI_COMMAND_LINE_H

#include "cli/option_values.h"
#include "request/Request.h"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace equiaffine {

/// By default z is up for formulas and volumes. For data, `up` is guessed from the shape.
inline void choose_up(Source_kind kind, Display_request& display) {
  if (kind != Source_kind::FIT && kind != Source_kind::DISTANCE) display.guesses_up = false;
}

/// Commands of an option, as bits.
using Commands = unsigned;

/// The commands that look for maps.
inline constexpr Commands registering = REGISTER | SYMMETRIES;

/// The section of the help that lists an option. Its title depends on the command; see title_of() in command_line.cpp.
enum class Option_group { INPUT, SOURCE, BOX, FIT, SURFACE, SAMPLING, MARCHING_CUBES, DELAUNAY, REMESH, MAPS, OUTPUT };

/// Whether the options of the group belong to the source or its surface. With `register`, which has two sources, other
/// options may stand on either side of the word `to`.
inline bool belongs_to_source(Option_group group) {
  return group != Option_group::MAPS && group != Option_group::OUTPUT;
}

/// The number of words after the name of an option.
struct Number_of_words {
  int least, most; ///< `most` is unlimited if it is 0 and `least` is not

  constexpr Number_of_words(int exactly) : least(exactly), most(exactly) {}
  constexpr Number_of_words(int at_least, int at_most) : least(at_least), most(at_most) {}
};

constexpr int unlimited = 0;

/// Everything about one option. To add an option, add a row to source_options.cpp, surface_options.cpp or
/// output_options.cpp.
struct Option_row {
  /// Such as "-o,--output"; a positional argument has a name without dashes. Further long names are aliases, which the
  /// help does not show.
  std::string names;
  Commands commands;
  Option_group group;
  Number_of_words words;
  std::string type; ///< placeholder of the words in the help
  std::string help;
  /// Stores the value of the words in the request. Throws `Input_error` if they are invalid.
  void (*read)(const Option_words& option, Request& request);

  /// The name of the option in C++ and Python (min_overlap for --min-overlap), or of the positional argument.
  std::string name() const;

  /// Whether the word is one of the names.
  bool has_name(const std::string& word) const {
    return (',' + names + ',').find(',' + word + ',') != std::string::npos;
  }
};

/// The parts of the table, in the order of the help.
std::span<const Option_row> source_options();
std::span<const Option_row> surface_options();
std::span<const Option_row> map_options();
std::span<const Option_row> output_options();

/// The rows of the command, in the order of its help.
std::vector<const Option_row*> options_of(Command command);

/// The given options with their words, not interpreted yet.
struct Command_line {
  Command command = MESH;
  std::map<std::string, Words> options;   ///< by the name() of the option's row
  std::optional<std::string> information; ///< help or version, if requested
  bool writes_files = true; ///< false if results are returned; then options of sources name data in memory

  bool has(const std::string& option) const { return options.count(option) > 0; }

  /// The first word of an option that is given.
  const std::string& word(const std::string& option) const { return options.at(option).front(); }
};

/// Splits the command line with CLI11. An option takes the words it needs whatever they look like, so `-.5` and `-x^2`
/// need no special quoting. Throws `Input_error` if the line does not follow the grammar.
Command_line split_command_line(const std::vector<std::string>& arguments);

} // namespace equiaffine

#endif
