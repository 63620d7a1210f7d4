// SPDX-License-Identifier: GPL-3.0-or-later
#include "display/oklab.h"
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/display/color_map.h>

#include <CGAL/IO/Color.h>
#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <tuple>
#include <vector>

namespace equiaffine {

namespace {

bool is_below(const Weighted_number& each, double number) { return each.number < number; }

/// The numbers, in order away from zero, at which each step of their total weight is reached.
template <class Iterator>
std::array<double, Equalization::steps> knots_of(Iterator begin, Iterator end, double greatest) {
  constexpr std::size_t steps = Equalization::steps;
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

} // namespace

std::vector<double> sorted_magnitudes(const std::vector<double>& sorted) {
  const auto zero = std::lower_bound(sorted.begin(), sorted.end(), 0.);
  std::vector<double> negative(std::make_reverse_iterator(zero), sorted.rend()), result(sorted.size());
  for (double& value : negative) value = -value;
  std::merge(negative.begin(), negative.end(), zero, sorted.end(), result.begin());
  return result;
}

Color_range color_range_of_sorted(const std::vector<double>& sorted, const std::vector<double>& magnitudes,
                                  double clip_percent, double resolution, double error) {
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

Color_range color_range(std::vector<double> values, double clip_percent, double resolution) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  std::sort(values.begin(), values.end());
  return color_range_of_sorted(values, sorted_magnitudes(values), clip_percent, resolution);
}

Color_range given_range(double lower, double upper) {
  CGAL_precondition(lower < upper);
  constexpr double knees = 100;
  return {lower, upper, std::max(std::abs(lower), std::abs(upper)) / knees, lower == -upper};
}

CGAL::IO::Color undefined_color() { return CGAL::IO::Color(157, 157, 163); }

CGAL::IO::Color plain_color() { return CGAL::IO::Color(201, 209, 220); }

CGAL::IO::Color doubt_color() { return CGAL::IO::Color(136, 136, 136); }

CGAL::IO::Color parabolic_region_color() { return CGAL::IO::Color(166, 205, 178); }

CGAL::IO::Color diverging_color(double t) {
  CGAL_precondition(!(std::abs(t) > 1));
  return std::isnan(t) ? undefined_color() : internal::color_from_linear_rgb(internal::diverging_linear_rgb(t));
}

CGAL::IO::Color sequential_color(double t) {
  CGAL_precondition(!(t < 0 || t > 1));
  return std::isnan(t) ? undefined_color() : internal::color_from_linear_rgb(internal::sequential_linear_rgb(t));
}

CGAL::IO::Color status_color(Point_status status) {
  switch (status) {
  case Point_status::PARABOLIC: return CGAL::IO::Color(18, 161, 80);
  case Point_status::SINGULAR: return CGAL::IO::Color(17, 17, 17);
  case Point_status::OUTSIDE: return CGAL::IO::Color(160, 124, 60);
  case Point_status::UNCONVERGED: return CGAL::IO::Color(0, 194, 214);
  case Point_status::REGULAR: break;
  }
  return plain_color();
}

Equalization::Equalization(std::vector<Weighted_number> numbers) {
  std::sort(numbers.begin(), numbers.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  const double greatest =
      numbers.empty() ? 1 : std::max(std::abs(numbers.front().number), std::abs(numbers.back().number));
  const auto negative = std::lower_bound(numbers.begin(), numbers.end(), 0., is_below);
  const auto positive = std::find_if(negative, numbers.end(), [](const auto& each) { return each.number > 0; });
  knots_[steps] = 0;
  const auto down = knots_of(std::make_reverse_iterator(negative), numbers.rend(), -greatest);
  const auto up = knots_of(positive, numbers.end(), greatest);
  std::copy(down.rbegin(), down.rend(), knots_.begin());
  std::copy(up.begin(), up.end(), knots_.begin() + steps + 1);
}

double Equalization::operator()(double number) const {
  const auto [first, last] = std::equal_range(knots_.begin(), knots_.end(), number);
  const auto index = [&](auto knot) { return double(knot - knots_.begin()); };
  if (first != last) return (index(first) + index(last) - 1) / (2. * steps) - 1; // the middle of a step
  if (first == knots_.begin()) return -1;
  if (first == knots_.end()) return 1;
  const double below = *std::prev(first);
  return (index(first) - 1 + (number - below) / (*first - below)) / steps - 1;
}

double Color_mapping::position(double value) const {
  if (std::isnan(value)) return value;
  const double clipped = std::clamp(value, range.lower, range.upper);
  if (!range.is_diverging) return part(clipped, range.lower, range.upper);
  return clipped < 0 ? -part(clipped, 0, range.lower) : part(clipped, 0, range.upper);
}

CGAL::IO::Color Color_mapping::color(double value) const {
  const double t = position(value);
  return range.is_diverging ? diverging_color(t) : sequential_color(t);
}

double Color_mapping::scaled(double value) const {
  switch (scale) {
  case Color_scale::ASINH: return std::asinh(value / range.knee);
  case Color_scale::EQUALIZED: return equalization(value);
  case Color_scale::LINEAR: break;
  }
  return value;
}

double Color_mapping::part(double value, double begin, double end) const {
  const double from = scaled(begin), to = scaled(end);
  return from == to ? (value - begin) / (end - begin) : (scaled(value) - from) / (to - from);
}

} // namespace equiaffine
