// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_QUANTILE_H
#define EQUIAFFINE_BASE_INTERNAL_QUANTILE_H

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine {

/// The element with index n in ascending order. \pre n < values.size()
inline double nth_smallest(std::vector<double> values, std::size_t n) {
  CGAL_precondition(n < values.size());
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// The median; for an even count the larger of the two middle elements. \pre not empty
inline double median_of(std::vector<double> values) {
  const std::size_t middle = values.size() / 2;
  return nth_smallest(std::move(values), middle);
}

/// The `percent`-quantile of ascending numbers, with linear interpolation. \pre not empty
inline double quantile_of_sorted(const std::vector<double>& sorted, double percent) {
  CGAL_precondition(!sorted.empty() && percent >= 0 && percent <= 100);
  const double rank = percent / 100 * double(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  if (below + 1 == sorted.size()) return sorted[below];
  return sorted[below] + (rank - double(below)) * (sorted[below + 1] - sorted[below]);
}

/// The same for unsorted numbers, which are reordered.
inline double quantile(std::vector<double>& values, double percent) {
  CGAL_precondition(!values.empty() && percent >= 0 && percent <= 100);
  const double rank = percent / 100 * double(values.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(below);
  std::nth_element(values.begin(), nth, values.end());
  if (below + 1 == values.size()) return *nth;
  const double next = *std::min_element(nth + 1, values.end());
  return *nth + (rank - double(below)) * (next - *nth);
}

} // namespace equiaffine

#endif
