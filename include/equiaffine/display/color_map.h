// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DISPLAY_COLOR_MAP_H
#define EQUIAFFINE_DISPLAY_COLOR_MAP_H

#include <equiaffine/base/internal/compiler.h>
#include <equiaffine/geometry/Point_status.h>

#include <CGAL/IO/Color.h>

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

/// \file
/// The one mapping from a number to a color: every picture of this library uses it.
/// The steps are: number -> `Color_range` of the whole column -> position on the map by a `Color_mapping` -> color,
/// sRGB. The maps are straight paths in Oklab (B. Ottosson, "A perceptual color space for image processing", 2020):
/// lightness alone, which no form of color blindness takes away, tells the order.

// The library defines the functions below that have no body here.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
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
std::vector<double> sorted_magnitudes(const std::vector<double>& sorted);

/// The range of a column of numbers; infinities and NaNs do not count. For numbers of both signs the bounds are +-(the
/// (100 - clip_percent)-quantile of |value|), for numbers of one sign the quantiles at clip_percent and 100 -
/// clip_percent, or 0 below a millionth of that largest |value|, from which on a sign counts. `resolution` >= 0, in the
/// unit of the numbers, is the least half-width worth a color. A relative half-width is at least a millionth, as pages
/// store single precision. Numbers look like zero instead of like noise if at least half of them are below the
/// resolution and that largest |value| is below a thousand resolutions, since rounding grows beside a parabolic curve:
/// their range is a billion resolutions, which is the unit of the numbers where the resolution is 1e-9 of it. `error`
/// is what the numbers are typically off: a half-width is at least 8 errors, so that numbers that are equal within
/// their errors have one color. It does not take the range of numbers of one sign across zero.
/// \pre `sorted` is ascending and finite, `magnitudes` has its absolute values, ascending
Color_range color_range_of_sorted(const std::vector<double>& sorted, const std::vector<double>& magnitudes,
                                  double clip_percent, double resolution, double error = 0);

/// The same of numbers in any order.
Color_range color_range(std::vector<double> values, double clip_percent = default_clip_percent, double resolution = 0);

/// A range that was typed: it depends on nothing but its bounds, so that pictures that share it can be compared.
Color_range given_range(double lower, double upper);

/// The color of a number that does not exist.
CGAL::IO::Color undefined_color();

/// The color of a surface without a quantity, and of regular points where the status is shown.
CGAL::IO::Color plain_color();

/// The gray of colors that say nothing, in legends: a color in doubt keeps its own lightness.
CGAL::IO::Color doubt_color();

/// The color of regions where a number does not exist because the Gaussian curvature is zero within its error: the hue
/// of parabolic points, too pale to be taken for a curve.
CGAL::IO::Color parabolic_region_color();

/// The diverging map, for t in [-1, 1]: blue, near-white at 0, red; gray for NaN.
CGAL::IO::Color diverging_color(double t);

/// The sequential map, for t in [0, 1]: pale yellow to dark violet; gray for NaN.
CGAL::IO::Color sequential_color(double t);

/// The color of a point by its status: hues and darkness that neither map has.
CGAL::IO::Color status_color(Point_status status);

// From the numbers of an attribute to the places of their colors, by rank or not.

/// A number, and the area of the surface that has it.
struct Weighted_number {
  double number, ///< the number
      weight;    ///< the area, in any unit
};

/// A monotone function from numbers to [-1, 1] that keeps zero and gives equal areas of the surface equal parts of
/// [-1, 0] and of [0, 1]: the rank of a number among those of its sign.
class Equalization {
public:
  static constexpr std::size_t steps = 64;         ///< for each sign
  using Knots = std::array<double, 2 * steps + 1>; ///< numbers, ascending

  /// Linear on [-1, 1].
  Equalization() : Equalization(std::vector<Weighted_number>()) {}

  /// The function for these finite numbers. A sign without a number has a linear one up to the greatest of the others.
  explicit Equalization(std::vector<Weighted_number> numbers);

  /// The function with these ascending values of its inverse at equal steps.
  explicit Equalization(const Knots& knots) : knots_(knots) {}

  /// The place of a number in [-1, 1].
  double operator()(double number) const;

  /// The numbers whose places are -1, 1 / steps - 1, ..., 1.
  const Knots& knots() const { return knots_; }

  friend bool operator==(const Equalization&, const Equalization&) = default; ///< of knots

private:
  Knots knots_{};
};

/// The way from a number to a place on its map, and to its color.
struct Color_mapping {
  Color_range range;                       ///< the numbers of the end colors
  Color_scale scale = Color_scale::LINEAR; ///< how numbers between them are placed
  Equalization equalization = {};          ///< for the scale of that name

  /// The place of a number: in [-1, 1] with zero at 0 for a diverging range, otherwise in [0, 1]. Monotone; NaN stays
  /// NaN.
  double position(double value) const;

  /// The color of a number on the map that the range asks for.
  CGAL::IO::Color color(double value) const;

  friend bool operator==(const Color_mapping&, const Color_mapping&) = default; ///< of all members

private:
  double scaled(double value) const;

  /// The part of the way from `begin` to `end`, linear where the scale does not tell them apart.
  double part(double value, double begin, double end) const;
};

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
