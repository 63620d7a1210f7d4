// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_CLI_FORMULA_FILE_H
#define EQUIAFFINE_PROGRAM_CLI_FORMULA_FILE_H

#include <optional>
#include <string>

namespace equiaffine {

/// The path after the @ if the word of --function is `@FILE`, or nothing if it is a formula.
std::optional<std::string> formula_file(const std::string& word);

/// The formula in a file, with spaces for its line breaks. Throws `Input_error` if there is none, or none that could
/// be a formula.
std::string read_formula(const std::string& path);

} // namespace equiaffine

#endif
