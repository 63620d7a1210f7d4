// SPDX-License-Identifier: GPL-3.0-or-later
#include "picture/natural_up.h"

#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <cmath>
#include <cstddef>
#include <iterator>

namespace equiaffine {

namespace {

/// The part of the box, seen along an axis, that is covered by the convex hull of the lowest points.
double part_of_foot(const std::vector<Kernel::Point_3>& points, const CGAL::Bbox_3& box, int axis) {
  constexpr double part_of_height = 0.03;
  const int across = (axis + 1) % 3, along = (axis + 2) % 3;
  const auto span = [&](int k) { return box.max(k) - box.min(k); };
  using Point_2 = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2; // a hull needs exact predicates
  std::vector<Point_2> lowest, hull;
  for (const Kernel::Point_3& p : points)
    if (p[axis] <= box.min(axis) + part_of_height * span(axis)) lowest.emplace_back(p[across], p[along]);
  CGAL::convex_hull_2(lowest.begin(), lowest.end(), std::back_inserter(hull));
  double area = 0;
  for (std::size_t i = 2; i < hull.size(); ++i) area += CGAL::area(hull[0], hull[i - 1], hull[i]);
  const double whole = span(across) * span(along);
  return whole > 0 ? area / whole : 0;
}

} // namespace

std::array<double, 3> natural_up(const std::vector<Kernel::Point_3>& points) {
  constexpr double least = 0.1, wider = 2;
  CGAL::Bbox_3 box;
  for (const Kernel::Point_3& p : points) box += p.bbox();
  const double y = part_of_foot(points, box, 1), z = part_of_foot(points, box, 2);
  if (z >= least && z >= wider * y) return {0, 0, 1};
  return {0, 1, 0};
}

} // namespace equiaffine
