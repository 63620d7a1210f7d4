// SPDX-License-Identifier: GPL-3.0-or-later
// From the numbers of an attribute to the places of their colors, by rank or not.
#ifndef EQUIAFFINE_DISPLAY_COLOR_MAPPING_H
#define EQUIAFFINE_DISPLAY_COLOR_MAPPING_H

#include <equiaffine/display/color_map.h>

#include <CGAL/IO/Color.h>

#include <array>
#include <cstddef>
#include <vector>

// The library defines the members that have no body here.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine {

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
