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
/// The mapping from a number to a color that every picture of this library uses.
/// The steps are: number -> `Color_range` of the whole column -> position on the map by a `Color_mapping` -> sRGB
/// color. The maps are straight paths in Oklab (B. Ottosson, "A perceptual color space for image processing", 2020),
/// so that lightness alone shows the order of the numbers, also for readers with color blindness.

// The functions without a body are compiled into the library.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

/// How a number is placed between the end colors.
enum class Color_scale {
  LINEAR,   ///< proportional
  ASINH,    ///< linear below `Color_range::knee`, logarithmic above, with the sign kept
  EQUALIZED ///< by rank, with the sign kept: see `Color_mapping`
};

/// The numbers of the two end colors. Numbers beyond them get the same colors.
struct Color_range {
  double lower;      ///< the smaller one
  double upper;      ///< the larger one
  double knee;       ///< the median of |value|, at least the smallest difference worth a color: > 0
  bool is_diverging; ///< whether lower == -upper, and zero is the middle of the diverging map; else sequential

  friend bool operator==(const Color_range&, const Color_range&) = default; ///< of all members
};

/// The default percentage of numbers that are clipped to the end color at each end.
inline constexpr double default_clip_percent = 2;

/// The percentages that pages can clip at each end of the range.
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

/// The absolute values of ascending numbers, in ascending order.
std::vector<double> sorted_magnitudes(const std::vector<double>& sorted);

/// The range of a column of numbers, without infinities and NaNs. For numbers of both signs, the bounds are +-(the
/// (100 - clip_percent)-quantile of |value|). For numbers of one sign, they are the quantiles at clip_percent and
/// 100 - clip_percent, or 0 if below a millionth of that largest |value|; smaller numbers do not count as signed.
///
/// `resolution` >= 0, in the unit of the numbers, is the minimum half-width worth a color. The relative half-width is
/// at least a millionth, because pages store single precision. Numbers are shown as zero, not as noise, if at least
/// half of them are below the resolution and that largest |value| is below a thousand resolutions (rounding grows
/// near a parabolic curve). Their range is then a billion resolutions, which is the unit of the numbers if the
/// resolution is 1e-9 of it.
///
/// `error` is the typical error of the numbers. The half-width is at least 8 errors, so that numbers that are equal
/// within their errors have one color, but this does not extend the range of numbers of one sign across zero.
/// \pre `sorted` is ascending and finite, `magnitudes` has its absolute values in ascending order
Color_range color_range_of_sorted(const std::vector<double>& sorted, const std::vector<double>& magnitudes,
                                  double clip_percent, double resolution, double error = 0);

/// The same for numbers in any order.
Color_range color_range(std::vector<double> values, double clip_percent = default_clip_percent, double resolution = 0);

/// A range given by the user. It depends only on its bounds, so that pictures with the same range can be compared.
Color_range given_range(double lower, double upper);

/// The color of an undefined number.
CGAL::IO::Color undefined_color();

/// The color of a surface without a quantity, and of regular points if the status is shown.
CGAL::IO::Color plain_color();

/// The gray of uncertain colors in legends. On the surface, an uncertain color keeps its lightness.
CGAL::IO::Color doubt_color();

/// The color of regions where a number is undefined because the Gaussian curvature is zero within its error: the hue
/// of parabolic points, but too pale to be mistaken for a curve.
CGAL::IO::Color parabolic_region_color();

/// The diverging map for t in [-1, 1]: blue, near-white at 0, red; gray for NaN.
CGAL::IO::Color diverging_color(double t);

/// The sequential map for t in [0, 1]: pale yellow to dark violet; gray for NaN.
CGAL::IO::Color sequential_color(double t);

/// The color of a point by its status, in hues and lightnesses that neither map contains.
CGAL::IO::Color status_color(Point_status status);

// From the numbers of an attribute to positions on a color map, by rank or not.

/// A number and the area of the surface that has it.
struct Weighted_number {
  double number, ///< the number
      weight;    ///< the area, in any unit
};

/// A monotone function from numbers to [-1, 1] that preserves zero and maps equal areas of the surface to equal parts
/// of [-1, 0] and of [0, 1]: the rank of a number among those of its sign.
class Equalization {
public:
  static constexpr std::size_t steps = 64;         ///< for each sign
  using Knots = std::array<double, 2 * steps + 1>; ///< ascending numbers

  /// Linear on [-1, 1].
  Equalization() : Equalization(std::vector<Weighted_number>()) {}

  /// The function for these finite numbers. Without numbers of one sign, it is linear there, up to the largest
  /// |number|.
  explicit Equalization(std::vector<Weighted_number> numbers);

  /// The function with these ascending values of its inverse at equal steps.
  explicit Equalization(const Knots& knots) : knots_(knots) {}

  /// The position of a number in [-1, 1].
  double operator()(double number) const;

  /// The numbers at the positions -1, 1 / steps - 1, ..., 1.
  const Knots& knots() const { return knots_; }

  friend bool operator==(const Equalization&, const Equalization&) = default; ///< of knots

private:
  Knots knots_{};
};

/// The mapping from a number to a position on a color map, and to its color.
struct Color_mapping {
  Color_range range;                       ///< the numbers of the end colors
  Color_scale scale = Color_scale::LINEAR; ///< how numbers between them are placed
  Equalization equalization = {};          ///< for Color_scale::EQUALIZED

  /// The position of a number, a monotone function: in [-1, 1] with zero at 0 for a diverging range, otherwise in [0,
  /// 1]. NaN for NaN.
  double position(double value) const;

  /// The color of a number on the diverging or sequential map, depending on the range.
  CGAL::IO::Color color(double value) const;

  friend bool operator==(const Color_mapping&, const Color_mapping&) = default; ///< of all members

private:
  double scaled(double value) const;

  /// The relative position between `begin` and `end`; linear if the scale maps both to the same number.
  double part(double value, double begin, double end) const;
};

} // namespace equiaffine
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
