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

/// Options of a page or a picture of a surface: what it shows first, and its text. All text is UTF-8.
struct Display_options {
  std::string title = "Equi-affine curvatures"; ///< also the name of files that are saved from the page
  /// The attribute shown first, or `status`, or `plain`; if empty, the first available quantity of the library whose
  /// values are trusted.
  std::string color = {};
  /// The upward direction in the first view, which is also the axis of rotation by dragging.
  std::array<double, 3> up = {0, 0, 1};
  /// The numbers of the end colors of the attribute shown first; if empty, quantiles of its numbers.
  std::optional<std::array<double, 2>> range = {};
  /// The color scale for all attributes; if empty, one that suits the numbers of each.
  std::optional<Color_scale> colors = {};
  std::array<std::size_t, 2> size = {1000, 800}; ///< of a picture, in pixels
  std::string arrows = {};                       ///< a vector attribute, for a picture; none if empty
  /// Color mappings for the attributes named here, such as those of another page, instead of mappings from their
  /// numbers.
  std::map<std::string, Color_mapping> mappings = {};
  /// Text after the labels and symbols of the library's quantities, such as " at scale 0.1".
  std::string label_suffix = {};
  /// A table on the page that describes the surface and how it was computed.
  std::vector<std::pair<std::string, std::string>> description = {};
};

} // namespace equiaffine

#endif
