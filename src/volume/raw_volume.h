// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_VOLUME_RAW_VOLUME_H
#define EQUIAFFINE_SRC_VOLUME_RAW_VOLUME_H

#include "system/kernel.h"
#include <equiaffine/Volume_3.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace equiaffine {

/// The types of samples in a file without a header.
inline constexpr std::array<std::string_view, 10> raw_types = {"uint8", "int8",   "uint16", "int16", "uint32",
                                                               "int32", "uint64", "int64",  "float", "double"};

/// What a file of samples without a header does not say itself.
struct Raw_layout {
  std::array<std::size_t, 3> dims;
  std::array<double, 3> spacing = {1, 1, 1}, origin = {0, 0, 0};
  std::size_t type; ///< in raw_types
};

/// Reads samples one after the other, the first index fastest, in the byte order of this computer. Throws `Input_error`
/// unless the file has exactly the size that the layout says.
Volume_3<Kernel> read_raw_volume(const std::string& path, const Raw_layout& layout);

} // namespace equiaffine

#endif
