// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/display/Color_mapping.h>
#include <equiaffine/display/color_map.h>

#include <CGAL/IO/Color.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace equiaffine {

namespace {

bool is_below(const Weighted_number& each, double number) { return each.number < number; }

/// The numbers, growing away from zero, at which each step of their total weight is reached.
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
