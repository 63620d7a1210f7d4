// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_PICTURE_SURFACE_VIEW_H
#define EQUIAFFINE_PROGRAM_PICTURE_SURFACE_VIEW_H

#include "picture/Surface_note.h"
#include <equiaffine/display/Color_mapping.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace equiaffine {

/// Options that say how a surface is shown.
struct Surface_view {
  std::string color;                             ///< a column, `status`, `plain`, or empty for the page's choice
  std::array<double, 3> up = {0, 0, 1};          ///< the direction that points up
  std::array<std::size_t, 2> size;               ///< in pixels
  std::optional<std::array<double, 2>> range;    ///< the numbers of the end colors, instead of quantiles
  std::string arrows;                            ///< a vector among the columns, or empty
  std::optional<Color_scale> scale;              ///< instead of the one that suits the numbers
  std::map<std::string, Color_mapping> mappings; ///< of columns whose colors do not depend on their own numbers
  std::string label_suffix = {};                 ///< what follows the labels of the library's quantities
  std::vector<Surface_note> notes = {};          ///< below the surface, from the top to the bottom
};

} // namespace equiaffine

#endif
