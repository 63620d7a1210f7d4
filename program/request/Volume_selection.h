// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_REQUEST_VOLUME_SELECTION_H
#define EQUIAFFINE_PROGRAM_REQUEST_VOLUME_SELECTION_H

#include <cstddef>
#include <optional>

namespace equiaffine {

/// What is read of a file with volumes, beside those that it says itself.
struct Volume_selection {
  std::optional<std::size_t> component = {},
                             time = {}; ///< the number per node and the volume of a 4D file, counted from 1
  bool allows_outside = false;          ///< whether a header may name files outside of its folder
};

} // namespace equiaffine

#endif
