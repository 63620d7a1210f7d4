// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_OUTPUT_READ_MAPPINGS_H
#define EQUIAFFINE_PROGRAM_OUTPUT_READ_MAPPINGS_H

#include <equiaffine/display/Color_mapping.h>

#include <map>
#include <string>

namespace equiaffine {

/// Reads the way from numbers to colors of each attribute of a page of ours, .html, or of a mesh, .ply. Throws
/// `Input_error` if the file is neither.
std::map<std::string, Color_mapping> read_mappings(const std::string& path);

} // namespace equiaffine

#endif
