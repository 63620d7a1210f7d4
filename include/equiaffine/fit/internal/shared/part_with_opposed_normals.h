// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_SHARED_PART_WITH_OPPOSED_NORMALS_H
#define EQUIAFFINE_FIT_INTERNAL_SHARED_PART_WITH_OPPOSED_NORMALS_H

#include <equiaffine/base/internal/shared/parallel_for.h>
#include <equiaffine/fit/internal/data/Point_tree_3.h>

#include <CGAL/number_utils.h>
#include <CGAL/tags.h>
#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace equiaffine {

/// Returns the part of points with normals whose normal is opposed to that of the nearest other point: about 0 for a
/// surface with a side, and more where normals contradict each other, so that fits cannot use them. It is 0 for less than
/// two points. Takes O(n log n) time.
template <class ConcurrencyTag = CGAL::Sequential_tag, class Point_3, class Vector_3>
double part_with_opposed_normals(const std::vector<std::pair<Point_3, Vector_3>>& points) {
  std::vector<Eigen::Vector3d> places;
  for (const auto& [p, normal] : points)
    places.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  const internal::Point_tree_3 tree(places);
  std::vector<std::uint8_t> are_opposed(points.size(), 0);
  parallel_for<ConcurrencyTag>(
      0, points.size(),
      [&](std::size_t i) {
        for (const auto j : tree.nearest(places[i], 2))
          if (j != i && points[i].second * points[j].second < 0) are_opposed[i] = 1;
      },
      256);
  return points.empty() ? 0 : double(std::count(are_opposed.begin(), are_opposed.end(), 1)) / double(points.size());
}

} // namespace equiaffine

#endif
