// SPDX-License-Identifier: GPL-3.0-or-later
// From the numbers of an attribute to the places of their colors, by rank or not.
#ifndef EQUIAFFINE_DISPLAY_COLOR_MAPPING_H
#define EQUIAFFINE_DISPLAY_COLOR_MAPPING_H

#include <equiaffine/display/color_map.h>

#include <CGAL/IO/Color.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

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
  explicit Equalization(std::vector<Weighted_number> numbers) {
    std::sort(numbers.begin(), numbers.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    const double greatest =
        numbers.empty() ? 1 : std::max(std::abs(numbers.front().number), std::abs(numbers.back().number));
    const auto negative = std::lower_bound(numbers.begin(), numbers.end(), 0., is_less);
    const auto positive = std::find_if(negative, numbers.end(), [](const auto& each) { return each.number > 0; });
    knots_[steps] = 0;
    const auto down = knots_of(std::make_reverse_iterator(negative), numbers.rend(), -greatest);
    const auto up = knots_of(positive, numbers.end(), greatest);
    std::copy(down.rbegin(), down.rend(), knots_.begin());
    std::copy(up.begin(), up.end(), knots_.begin() + steps + 1);
  }

  /// The function with these ascending values of its inverse at equal steps.
  explicit Equalization(const Knots& knots) : knots_(knots) {}

  /// The place of a number in [-1, 1].
  double operator()(double number) const {
    const auto [first, last] = std::equal_range(knots_.begin(), knots_.end(), number);
    const auto index = [&](auto knot) { return double(knot - knots_.begin()); };
    if (first != last) return (index(first) + index(last) - 1) / (2. * steps) - 1; // the middle of a step
    if (first == knots_.begin()) return -1;
    if (first == knots_.end()) return 1;
    const double below = *std::prev(first);
    return (index(first) - 1 + (number - below) / (*first - below)) / steps - 1;
  }

  /// The numbers whose places are -1, 1 / steps - 1, ..., 1.
  const Knots& knots() const { return knots_; }

  friend bool operator==(const Equalization&, const Equalization&) = default; ///< of knots

private:
  static bool is_less(const Weighted_number& each, double number) { return each.number < number; }

  /// The numbers, growing away from zero, at which each step of their total weight is reached.
  template <class Iterator>
  static std::array<double, steps> knots_of(Iterator begin, Iterator end, double greatest) {
    std::array<double, steps> knots{};
    double total = 0, sum = 0;
    for (auto each = begin; each != end; ++each) total += each->weight;
    for (std::size_t step = 0; step < steps; ++step) {
      const double part = double(step + 1) / steps;
      if (begin == end) {
        knots[step] = part * greatest;
        continue;
      }
      while (sum + begin->weight < part * total && std::next(begin) != end) sum += (begin++)->weight;
      knots[step] = step + 1 == steps ? std::prev(end)->number : begin->number;
    }
    return knots;
  }

  Knots knots_{};
};

/// The way from a number to a place on its map, and to its color.
struct Color_mapping {
  Color_range range;                       ///< the numbers of the end colors
  Color_scale scale = Color_scale::LINEAR; ///< how numbers between them are placed
  Equalization equalization = {};          ///< for the scale of that name

  /// The place of a number: in [-1, 1] with zero at 0 for a diverging range, otherwise in [0, 1]. Monotone; NaN stays
  /// NaN.
  double position(double value) const {
    if (std::isnan(value)) return value;
    const double clipped = std::clamp(value, range.lower, range.upper);
    if (!range.is_diverging) return part(clipped, range.lower, range.upper);
    return clipped < 0 ? -part(clipped, 0, range.lower) : part(clipped, 0, range.upper);
  }

  /// The color of a number on the map that the range asks for.
  CGAL::IO::Color color(double value) const {
    const double t = position(value);
    return range.is_diverging ? diverging_color(t) : sequential_color(t);
  }

  friend bool operator==(const Color_mapping&, const Color_mapping&) = default; ///< of all members

private:
  double scaled(double value) const {
    switch (scale) {
    case Color_scale::ASINH: return std::asinh(value / range.knee);
    case Color_scale::EQUALIZED: return equalization(value);
    case Color_scale::LINEAR: break;
    }
    return value;
  }

  /// The part of the way from `begin` to `end`, linear where the scale does not tell them apart.
  double part(double value, double begin, double end) const {
    const double from = scaled(begin), to = scaled(end);
    return from == to ? (value - begin) / (end - begin) : (scaled(value) - from) / (to - from);
  }
};

} // namespace equiaffine

#endif
