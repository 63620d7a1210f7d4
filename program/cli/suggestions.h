// SPDX-License-Identifier: GPL-3.0-or-later
// Corrections of misspelled words, and of files, formulas and options that belong to another command or place.
#ifndef EQUIAFFINE_PROGRAM_CLI_SUGGESTIONS_H
#define EQUIAFFINE_PROGRAM_CLI_SUGGESTIONS_H

#include "cli/command_line.h"

#include <string>

namespace equiaffine {

/// ", did you mean 'candidate'?" for the only candidate that begins with the word, otherwise for the nearest one by
/// edit distance if it is near; empty if there is none.
std::string suggestion(const std::string& word, const Words& candidates);

/// What to write instead of an unexpected word; empty if nothing is plausible.
std::string advice_on_word(const Command_line& line, const std::string& word);

/// What to write instead of an option that the command does not have; empty if nothing is plausible.
std::string advice_on_option(Command command, const std::string& option);

/// What to write instead of an unknown command; empty if nothing is plausible.
std::string advice_on_command(const std::string& word);

/// Throws if the path of a surface looks like a formula.
void check_is_no_formula(const std::string& path);

/// Throws if the path of the file to annotate looks like a formula or has the extension of a volume.
void check_is_annotatable(const std::string& path);

/// Throws if a file with this extension has nothing to show.
void check_is_viewable(const std::string& path);

} // namespace equiaffine

#endif
