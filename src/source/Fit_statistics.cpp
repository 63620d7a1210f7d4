// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/Fit_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine {

namespace {

using Structures = std::span<const Fitted_structure_3<double>>;

/// The least, median and greatest of the numbers of structures that have one.
template <class Get>
std::array<double, 3> spread(Structures structures, Get get) {
  std::vector<double> numbers;
  for (const auto& s : structures)
    if (std::isfinite(get(s))) numbers.push_back(get(s));
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (numbers.empty()) return {nan, nan, nan};
  std::sort(numbers.begin(), numbers.end());
  return {numbers.front(), numbers[numbers.size() / 2], numbers.back()};
}

/// The part of the structures whose estimated error of K is below a part of |K| + H^2.
double part_known(Structures structures, double bound) {
  const auto known = std::count_if(structures.begin(), structures.end(), [&](const auto& s) {
    const auto& affine = s.structure.affine;
    const double size = std::abs(affine.gaussian_curvature) + affine.mean_curvature * affine.mean_curvature;
    return s.error.gaussian_curvature < bound * size;
  });
  return double(known) / double(structures.size());
}

} // namespace

Fit_statistics statistics_of(Structures structures) {
  Fit_statistics statistics;
  statistics.scales = spread(structures, [](const auto& s) { return s.scale; });
  statistics.noise = spread(structures, [](const auto& s) { return s.deviation; })[1];
  for (std::size_t n = 0; n < error_bounds.size(); ++n) statistics.known[n] = part_known(structures, error_bounds[n]);
  return statistics;
}

} // namespace equiaffine
