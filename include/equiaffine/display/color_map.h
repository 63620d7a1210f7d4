// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_COLOR_MAP_H
#define EQUIAFFINE_DISPLAY_COLOR_MAP_H

#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/display/internal/oklab.h>
#include <equiaffine/geometry/Point_status.h>

#include <CGAL/IO/Color.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <tuple>
#include <vector>

/// \file
/// The one mapping from a number to a color: every picture of this library uses it.
/// The steps are: number -> `Color_range` of the whole column -> position on the map by a `Color_mapping` -> color,
/// sRGB. The maps are straight paths in Oklab (B. Ottosson, "A perceptual color space for image processing", 2020):
/// lightness alone, which no form of color blindness takes away, tells the order.

namespace equiaffine {

/// The ways from a number to its place between the end colors.
enum class Color_scale {
  LINEAR,   ///< proportional
  ASINH,    ///< linear below `Color_range::knee`, logarithmic above, with the sign kept
  EQUALIZED ///< by rank, with the sign kept: see `Color_mapping`
};

/// The numbers that get the two end colors; beyond them colors stay the same.
struct Color_range {
  double lower;      ///< the least of them
  double upper;      ///< the greatest of them
  double knee;       ///< the median of |value|, at least the least difference worth a color: > 0
  bool is_diverging; ///< lower == -upper: zero is the middle of the diverging map; else the sequential map is used

  friend bool operator==(const Color_range&, const Color_range&) = default; ///< of all members
};

/// The share of numbers, in percent, that gets an end color at each end unless said otherwise.
inline constexpr double default_clip_percent = 2;

/// The shares, in percent, that pages can clip off the range at each end.
inline constexpr std::array<double, 12> clip_steps = {0, 0.1, 0.2, 0.5, 1, 2, 3, 5, 10, 15, 20, 25};

/// The word for a scale on pages and in options of the program.
constexpr std::string_view to_string(Color_scale scale) {
  switch (scale) {
  case Color_scale::ASINH: return "logarithmic";
  case Color_scale::EQUALIZED: return "equalized";
  case Color_scale::LINEAR: break;
  }
  return "linear";
}

/// The absolute values of ascending numbers, ascending.
inline std::vector<double> sorted_magnitudes(const std::vector<double>& sorted) {
  const auto zero = std::lower_bound(sorted.begin(), sorted.end(), 0.);
  std::vector<double> negative(std::make_reverse_iterator(zero), sorted.rend()), result(sorted.size());
  for (double& value : negative) value = -value;
  std::merge(negative.begin(), negative.end(), zero, sorted.end(), result.begin());
  return result;
}

/// The range of a column of numbers; infinities and NaNs do not count. For numbers of both signs the bounds are +-(the
/// (100 - clip_percent)-quantile of |value|), for numbers of one sign the quantiles at clip_percent and 100 -
/// clip_percent, or 0 below a millionth of that largest |value|, from which on a sign counts. `resolution` >= 0, in the
/// unit of the numbers, is the least half-width worth a color. A relative half-width is at least a millionth, as pages
/// store single precision. Numbers look like zero instead of like noise if at least half of them are below the
/// resolution and that largest |value| is below a thousand resolutions, since rounding grows beside a parabolic curve:
/// their range is a billion resolutions, which is the unit of the numbers where the resolution is 1e-9 of it. `error` is
/// what the numbers are typically off: a half-width is at least 8 errors, so that numbers that are equal within their
/// errors have one color. It does not take the range of numbers of one sign across zero.
/// \pre `sorted` is ascending and finite, `magnitudes` has its absolute values, ascending
inline Color_range color_range_of_sorted(const std::vector<double>& sorted, const std::vector<double>& magnitudes,
                                         double clip_percent, double resolution, double error = 0) {
  CGAL_precondition(clip_percent >= 0 && clip_percent < 50 && resolution >= 0 && error >= 0);
  const double least_half_width = std::max(resolution, 8 * error);
  constexpr double relative_resolution = 1e-6;
  constexpr double resolutions_of_rounding = 1e3, resolutions_of_unit = 1e9;
  const double unit = resolution > 0 ? resolutions_of_unit * resolution : 1;
  const Color_range range_of_zero = {-unit, unit, unit, true};
  if (sorted.empty()) return range_of_zero;

  double largest = quantile_of_sorted(magnitudes, 100 - clip_percent);
  if (largest == 0) largest = magnitudes.back();
  const double median = quantile_of_sorted(magnitudes, 50);
  if (median <= resolution && largest <= resolutions_of_rounding * resolution) return range_of_zero;
  const double knee = std::max({median, resolution, relative_resolution * largest});

  const double negligible = relative_resolution * largest;
  const bool has_both_signs = -negligible > sorted.front() && negligible < sorted.back();
  if (has_both_signs) {
    const double end = std::max(largest, least_half_width);
    return {-end, end, knee, true};
  }
  const auto bound = [&](double percent) {
    const double number = quantile_of_sorted(sorted, percent);
    return std::abs(number) < negligible ? 0 : number;
  };
  double lower = bound(clip_percent), upper = bound(100 - clip_percent);
  if (lower == 0 && upper == 0) std::tie(lower, upper) = std::minmax({0., sorted.front(), sorted.back()});
  const double middle = lower + (upper - lower) / 2;
  const double half_width = std::max({(upper - lower) / 2, least_half_width, relative_resolution * std::abs(middle)});
  if (lower >= 0 && middle < half_width) return {0, 2 * half_width, knee, false};
  if (upper <= 0 && -middle < half_width) return {-2 * half_width, 0, knee, false};
  return {middle - half_width, middle + half_width, knee, false};
}

/// The same of numbers in any order.
inline Color_range color_range(std::vector<double> values, double clip_percent = default_clip_percent,
                               double resolution = 0) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  std::sort(values.begin(), values.end());
  return color_range_of_sorted(values, sorted_magnitudes(values), clip_percent, resolution);
}

/// A range that was typed: it depends on nothing but its bounds, so that pictures that share it can be compared.
inline Color_range given_range(double lower, double upper) {
  CGAL_precondition(lower < upper);
  constexpr double knees = 100;
  return {lower, upper, std::max(std::abs(lower), std::abs(upper)) / knees, lower == -upper};
}

/// The color of a number that does not exist.
inline CGAL::IO::Color undefined_color() { return CGAL::IO::Color(157, 157, 163); }

/// The color of a surface without a quantity, and of regular points where the status is shown.
inline CGAL::IO::Color plain_color() { return CGAL::IO::Color(201, 209, 220); }

/// The gray of colors that say nothing, in legends: a color in doubt keeps its own lightness.
inline CGAL::IO::Color doubt_color() { return CGAL::IO::Color(136, 136, 136); }

/// The color of regions where a number does not exist because the Gaussian curvature is zero within its error: the hue
/// of parabolic points, too pale to be taken for a curve.
inline CGAL::IO::Color parabolic_region_color() { return CGAL::IO::Color(166, 205, 178); }

/// The diverging map, for t in [-1, 1]: blue, near-white at 0, red; gray for NaN.
inline CGAL::IO::Color diverging_color(double t) {
  CGAL_precondition(!(std::abs(t) > 1));
  return std::isnan(t) ? undefined_color() : internal::color_from_linear_rgb(internal::diverging_linear_rgb(t));
}

/// The sequential map, for t in [0, 1]: pale yellow to dark violet; gray for NaN.
inline CGAL::IO::Color sequential_color(double t) {
  CGAL_precondition(!(t < 0 || t > 1));
  return std::isnan(t) ? undefined_color() : internal::color_from_linear_rgb(internal::sequential_linear_rgb(t));
}

/// The color of a point by its status: hues and darkness that neither map has.
inline CGAL::IO::Color status_color(Point_status status) {
  switch (status) {
  case Point_status::PARABOLIC: return CGAL::IO::Color(18, 161, 80);
  case Point_status::SINGULAR: return CGAL::IO::Color(17, 17, 17);
  case Point_status::OUTSIDE: return CGAL::IO::Color(160, 124, 60);
  case Point_status::UNCONVERGED: return CGAL::IO::Color(0, 194, 214);
  case Point_status::REGULAR: break;
  }
  return plain_color();
}

} // namespace equiaffine

#endif
