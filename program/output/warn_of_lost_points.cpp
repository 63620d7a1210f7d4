// SPDX-License-Identifier: GPL-3.0-or-later
#include "output/warn_of_lost_points.h"

#include "system/file_format.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace equiaffine {

namespace {

template <class Number>
std::size_t number_of_distinct(const std::vector<Kernel::Point_3>& points) {
  std::vector<std::array<Number, 3>> rounded;
  for (const auto& p : points) rounded.push_back({Number(p.x()), Number(p.y()), Number(p.z())});
  std::sort(rounded.begin(), rounded.end());
  return std::size_t(std::unique(rounded.begin(), rounded.end()) - rounded.begin());
}

} // namespace

void warn_of_lost_points(const std::string& path, const std::vector<Kernel::Point_3>& points, Progress& progress) {
  if (file_format(path) != File_format::STL) return;
  const std::size_t given = number_of_distinct<double>(points), left = number_of_distinct<float>(points);
  if (100 * (given - left) < given || given == left) return;
  progress.warn("STL has single precision, in which " + std::to_string(given - left) + " of " + std::to_string(given) +
                " vertices are at the place of another; write .ply, .off or .obj, or move the surface to the origin");
}

} // namespace equiaffine
