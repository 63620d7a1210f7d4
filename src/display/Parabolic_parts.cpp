// SPDX-License-Identifier: GPL-3.0-or-later
#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/display/internal/Parabolic_parts.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine {

namespace {

constexpr std::size_t largest_spot = 12; // in vertices
constexpr unsigned has_convex = 1, has_saddle = 2, has_regular = 4;

} // namespace

Parabolic_parts::Parabolic_parts(const std::vector<Triangle>& triangles, const Vertex_attributes& attributes) {
  if (!attributes.status) return;
  for (const Point_status status : *attributes.status) is_parabolic_.push_back(status == Point_status::PARABOLIC);
  if (std::none_of(is_parabolic_.begin(), is_parabolic_.end(), [](bool is) { return is; })) return;
  parts_.assign(is_parabolic_.size(), Parabolic_part::NONE);
  if (const auto* column = find_column(attributes, "gaussian_curvature")) curvatures_ = column->values;
  find_parts(triangles, *attributes.status);
  for (const Triangle& triangle : triangles)
    if (std::any_of(triangle.begin(), triangle.end(), [&](auto v) { return parts_[v] == Parabolic_part::SPOT; }))
      triangles_of_spots_.push_back(triangle);
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (parts_[i] == Parabolic_part::SPOT) spots_.push_back(std::uint32_t(i));
}

std::vector<double> Parabolic_parts::filled(std::vector<double> numbers) const {
  for (std::size_t pass = 0; pass < largest_spot; ++pass) {
    std::vector<double> sums(spots_.size(), 0.), counts = sums;
    for (const Triangle& triangle : triangles_of_spots_)
      for (const std::uint32_t v : triangle) {
        if (parts_[v] != Parabolic_part::SPOT) continue;
        const auto spot = std::size_t(std::lower_bound(spots_.begin(), spots_.end(), v) - spots_.begin());
        for (const std::uint32_t other : triangle)
          if (other != v && std::isfinite(numbers[other])) {
            sums[spot] += numbers[other];
            ++counts[spot];
          }
      }
    for (std::size_t spot = 0; spot < spots_.size(); ++spot)
      if (double& number = numbers[spots_[spot]]; !std::isfinite(number) && counts[spot] > 0)
        number = sums[spot] / counts[spot];
  }
  return numbers;
}

std::vector<double> Parabolic_parts::sides(std::vector<double> curvatures) const {
  for (std::size_t i = 0; i < curvatures.size(); ++i) {
    const bool is_parabolic = !parts_.empty() && is_parabolic_[i];
    if (!std::isfinite(curvatures[i]) || (is_parabolic && parts_[i] != Parabolic_part::NONE))
      curvatures[i] = std::numeric_limits<double>::quiet_NaN();
    if (is_parabolic && parts_[i] == Parabolic_part::NONE) curvatures[i] = 0;
  }
  return filled(std::move(curvatures));
}

void Parabolic_parts::find_parts(const std::vector<Triangle>& triangles, const std::vector<Point_status>& status) {
  Disjoint_sets<std::uint32_t> clusters(is_parabolic_.size());
  std::vector<bool> is_region(is_parabolic_.size());
  for (const Triangle& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto a = triangle[k], b = triangle[(k + 1) % 3]; is_parabolic_[a] && is_parabolic_[b])
        clusters.unite(a, b);
    if (std::all_of(triangle.begin(), triangle.end(), [&](auto v) { return is_parabolic_[v]; }))
      for (const std::uint32_t v : triangle) is_region[v] = true;
  }
  std::vector<unsigned> sizes(is_parabolic_.size()), neighbors(is_parabolic_.size());
  for (std::uint32_t v = 0; v < is_parabolic_.size(); ++v)
    if (is_parabolic_[v]) ++sizes[clusters.find(v)];
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t v : triangle)
      for (const std::uint32_t other : triangle)
        if (is_parabolic_[v] && status[other] == Point_status::REGULAR) neighbors[clusters.find(v)] |= kind_of(other);
  for (std::uint32_t v = 0; v < is_parabolic_.size(); ++v) {
    if (!is_parabolic_[v]) continue;
    const std::uint32_t cluster = clusters.find(v);
    const bool has_one_side = (neighbors[cluster] & has_regular) != 0 &&
                              (neighbors[cluster] & (has_convex | has_saddle)) != (has_convex | has_saddle);
    if (sizes[cluster] <= largest_spot && has_one_side) parts_[v] = Parabolic_part::SPOT;
    else if (is_region[v]) parts_[v] = Parabolic_part::REGION;
  }
}

unsigned Parabolic_parts::kind_of(std::uint32_t regular) const {
  if (curvatures_.empty() || std::isnan(curvatures_[regular])) return has_regular;
  return has_regular | (curvatures_[regular] < 0 ? has_saddle : has_convex);
}

} // namespace equiaffine
