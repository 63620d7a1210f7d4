// SPDX-License-Identifier: GPL-3.0-or-later
// Functions of three coordinates are evaluated at many points in one call.
#ifndef EQUIAFFINE_FUNCTION_INTERNAL_EVALUATE_POINTS_H
#define EQUIAFFINE_FUNCTION_INTERNAL_EVALUATE_POINTS_H

#include <equiaffine/function/expand.h>
#include <equiaffine/number/Pack.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace equiaffine::internal {

/// A functor has a call on spans of coordinates and a span for the values.
template <class Function, class FT>
concept TakesSpans = requires(const Function& f, std::span<const FT> coordinates, std::span<FT> values) {
  f(coordinates, coordinates, coordinates, values);
};

/// values[i] becomes f at points[i].
template <class FT, class Function, class Point_3>
void values_at(const Function& f, std::span<const Point_3> points, std::span<FT> values) {
  if constexpr (TakesSpans<Function, FT>) {
    constexpr std::size_t block = 64;
    std::array<FT, block> x, y, z;
    for (std::size_t first = 0; first < points.size(); first += block) {
      const std::size_t count = std::min(block, points.size() - first);
      for (std::size_t i = 0; i < count; ++i) {
        const Point_3& p = points[first + i];
        x[i] = p.x(), y[i] = p.y(), z[i] = p.z();
      }
      const auto used = [&](const std::array<FT, block>& numbers) { return std::span(numbers).first(count); };
      f(used(x), used(y), used(z), values.subspan(first, count));
    }
  } else {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = f(points[i].x(), points[i].y(), points[i].z());
  }
}

/// jets[i] becomes the expansion of f at points[i], computed in packs.
/// \throw Lanes_disagree where f branches differently in the lanes of a pack.
template <int Order, class FT, class Function, class Point_3>
void expand_points(const Function& f, std::span<const Point_3> points, std::span<Jet_3<FT, Order>> jets) {
  using Lanes = Pack<FT>;
  for (std::size_t first = 0; first < points.size(); first += Lanes::size) {
    const std::size_t last = std::min(first + Lanes::size, points.size()) - 1;
    const auto lanes_of = [&](int axis) {
      return Lanes::generate([&](std::size_t i) { return points[std::min(first + i, last)][axis]; });
    };
    const auto pack = expand<Order, Lanes>(f, lanes_of(0), lanes_of(1), lanes_of(2));
    for (std::size_t i = first; i <= last; ++i)
      for (std::size_t n = 0; n < pack.size; ++n) jets[i].coefficients()[n] = pack.coefficients()[n][i - first];
  }
}

} // namespace equiaffine::internal

#endif
