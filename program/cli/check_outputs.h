// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_CLI_CHECK_OUTPUTS_H
#define EQUIAFFINE_PROGRAM_CLI_CHECK_OUTPUTS_H

#include "cli/Option_reader.h"

#include <optional>
#include <string>
#include <vector>

namespace equiaffine {

/// The paths of the files that the command line says to read, and of those that the headers of volumes among them name.
std::vector<std::string> input_files(const Option_reader& reader);

/// Throws if an output would replace what is read, or another output.
void check_outputs(const std::vector<std::string>& inputs, const std::vector<std::optional<std::string>>& outputs);

/// Throws if there is no `--output`.
void need_output(const Option_reader& reader);

/// Throws for options of a picture without `--png`.
void refuse_picture_options(const Option_reader& reader);

/// Throws for options of a page and of a picture without either.
void refuse_page_options(const Option_reader& reader);

} // namespace equiaffine

#endif
