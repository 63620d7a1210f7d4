// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_HTML_OPTIONS_H
#define EQUIAFFINE_DISPLAY_HTML_OPTIONS_H

#include <equiaffine/display/Color_mapping.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace equiaffine {

/// Options for a page of `write_HTML`: the text on it and what it shows first. All text is UTF-8.
struct Html_options {
  std::string title = "Equi-affine curvatures"; ///< files that are saved from the page are named after it
  /// The attribute shown first, or `status`, or `plain`; empty: the first quantity of the library
  /// that is there and trusted (`first_shown`).
  std::string color = {};
  /// The numbers of the end colors of the attribute shown first; nothing: quantiles of its numbers.
  std::optional<std::array<double, 2>> range = {};
  /// The scale of colors for all attributes; nothing: the one that suits the numbers of each.
  std::optional<Color_scale> scale = {};
  /// The attributes named here have these mappings, such as those of another page, whatever their own numbers are.
  std::map<std::string, Color_mapping> mappings = {};
  /// What follows the labels and symbols of the library's quantities, such as " at scale 0.1".
  std::string label_suffix = {};
  /// A table that says what the surface is and how it was made.
  std::vector<std::pair<std::string, std::string>> description = {};
  /// The direction that is up in the first view and around which dragging turns.
  std::array<double, 3> up = {0, 0, 1};
};

} // namespace equiaffine

#endif
