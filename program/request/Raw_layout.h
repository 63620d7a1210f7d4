// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_REQUEST_RAW_LAYOUT_H
#define EQUIAFFINE_PROGRAM_REQUEST_RAW_LAYOUT_H

#include <array>
#include <cstddef>
#include <string_view>

namespace equiaffine {

/// The types of samples in a file without a header.
inline constexpr std::array<std::string_view, 10> raw_types = {"uint8", "int8",   "uint16", "int16", "uint32",
                                                               "int32", "uint64", "int64",  "float", "double"};

/// The facts about a file of samples that would be in a header, for a file without one.
struct Raw_layout {
  std::array<std::size_t, 3> dims = {};
  std::array<double, 3> spacing = {1, 1, 1}, origin = {0, 0, 0};
  std::size_t type = 0; ///< the position in raw_types
};

} // namespace equiaffine

#endif
