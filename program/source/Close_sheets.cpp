// SPDX-License-Identifier: GPL-3.0-or-later
#include "source/Close_sheets.h"

#include "source/source.h"
#include <equiaffine/base/internal/quantile.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine {

Close_sheets close_sheets(const Fit_traits& fit, const Source_options& options) {
  constexpr double steps_between_sheets = 1.5;
  const Lattice_3<Kernel> lattice(options.resolution.value_or(default_resolution(options.kind)), fit.bbox());
  double step = 0;
  for (const auto& s : lattice.steps()) step = std::max(step, std::sqrt(s.squared_length()));
  std::vector<double> distances = fit.distances_of_sheets(step);
  if (distances.empty()) return {0, std::numeric_limits<double>::quiet_NaN(), 0};
  const std::size_t count = distances.size();
  const double tenth = nth_smallest(std::move(distances), count / 10);
  const CGAL::Bbox_3 box = fit.bbox();
  const double longest = std::max({box.x_span(), box.y_span(), box.z_span()});
  return {count, tenth, std::size_t(std::min(1e9, steps_between_sheets * longest / tenth)) + 2};
}

} // namespace equiaffine
