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

using Structure = Fitted_structure_3<double>;

template <class Condition>
double part(Structures structures, const Condition& condition) {
  if (structures.empty()) return 0;
  return double(std::count_if(structures.begin(), structures.end(), condition)) / double(structures.size());
}

/// Whether the estimated error of K is below a part of |K| + H^2.
bool is_known(const Structure& s, double bound) {
  const auto& affine = s.structure.affine;
  const double size = std::abs(affine.gaussian_curvature) + affine.mean_curvature * affine.mean_curvature;
  return s.error.gaussian_curvature < bound * size;
}

bool is_doubtful(const Structure& s) {
  return s.structure.status == Point_status::REGULAR && !is_known(s, error_bounds.back());
}

bool is_noise(const Structure& s) { return s.noise.gaussian_curvature > s.error.gaussian_curvature / 2; }

} // namespace

Fit_statistics statistics_of(Structures structures) {
  Fit_statistics statistics;
  statistics.scales = spread(structures, [](const auto& s) { return s.scale; });
  statistics.noise = spread(structures, [](const auto& s) { return s.deviation; })[1];
  for (std::size_t n = 0; n < error_bounds.size(); ++n)
    statistics.known[n] = part(structures, [n](const Structure& s) { return is_known(s, error_bounds[n]); });
  statistics.without_fit =
      part(structures, [](const Structure& s) { return s.structure.status == Point_status::OUTSIDE; });
  statistics.doubtful_by_noise = part(structures, [](const Structure& s) { return is_doubtful(s) && is_noise(s); });
  statistics.doubtful_by_detail = part(structures, [](const Structure& s) { return is_doubtful(s) && !is_noise(s); });
  return statistics;
}

} // namespace equiaffine
