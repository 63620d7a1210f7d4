// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_DISPLAY_OPTIONS_H
#define EQUIAFFINE_DISPLAY_DISPLAY_OPTIONS_H

#include <equiaffine/display/color_map.h>

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

/// Options for a page or a picture of a surface: what it shows first, and the text on it. All text is UTF-8.
struct Display_options {
  std::string title = "Equi-affine curvatures"; ///< files that are saved from the page are named after it
  /// The attribute shown first, or `status`, or `plain`; empty: the first quantity of the library that is there and
  /// trusted.
  std::string color = {};
  /// The direction that is up in the first view and around which dragging turns.
  std::array<double, 3> up = {0, 0, 1};
  /// The numbers of the end colors of the attribute shown first; nothing: quantiles of its numbers.
  std::optional<std::array<double, 2>> range = {};
  /// The scale of colors for all attributes; nothing: the one that suits the numbers of each.
  std::optional<Color_scale> colors = {};
  std::array<std::size_t, 2> size = {1000, 800}; ///< of a picture, in pixels
  std::string arrows = {};                       ///< a vector among the attributes, for a picture; empty: none
  /// The attributes named here have these mappings, such as those of another page, whatever their own numbers are.
  std::map<std::string, Color_mapping> mappings = {};
  /// The text after the labels and symbols of the library's quantities, such as " at scale 0.1".
  std::string label_suffix = {};
  /// A table of a page that says what the surface is and how it was made.
  std::vector<std::pair<std::string, std::string>> description = {};
};

} // namespace equiaffine

#endif
