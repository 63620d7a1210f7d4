// SPDX-License-Identifier: GPL-3.0-or-later
// What to write instead of a word with a typing error, or of a file, a formula or an option that belongs to another
// command or place.
#ifndef EQUIAFFINE_PROGRAM_CLI_SUGGESTIONS_H
#define EQUIAFFINE_PROGRAM_CLI_SUGGESTIONS_H

#include "cli/command_line.h"

#include <string>

namespace equiaffine {

/// ", did you mean 'candidate'?" for the only candidate that begins with the word, or else the one with the fewest
/// typing errors, if they are few; else nothing.
std::string suggestion(const std::string& word, const Words& candidates);

/// What to write instead of a word that the line of a command has no place for; empty if nothing is plausible.
std::string advice_on_word(const Command_line& line, const std::string& word);

/// What to write instead of an option that the command does not have; empty if nothing is plausible.
std::string advice_on_option(Command command, const std::string& option);

/// What to write instead of a word that is no command; empty if nothing is plausible.
std::string advice_on_command(const std::string& word);

/// Throws if what is to be the file of a surface looks like a formula.
void check_is_no_formula(const std::string& path);

/// Throws if the file to annotate looks like a volume or a formula.
void check_is_annotatable(const std::string& path);

/// Throws if the file to view is known by its extension to have nothing to show.
void check_is_viewable(const std::string& path);

} // namespace equiaffine

#endif
