// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_BORDER_POINTS_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_BORDER_POINTS_H

#include <equiaffine/surface/Clip_domain_3.h>

#include <CGAL/Bbox_3.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace equiaffine::internal {

/// Calls visit(x, y, z) for points of a sphere, which a spiral about its axis spreads evenly.
template <class Visit>
void for_each_point_of_sphere(const std::array<double, 3>& center, double radius, double spacing, const Visit& visit) {
  using std::numbers::pi;
  const double count = std::ceil(4 * pi * (radius / spacing) * (radius / spacing)) + 4;
  for (double n = 0; n < count; ++n) {
    const double z = (2 * n + 1) / count - 1, r = std::sqrt(1 - z * z), angle = 2 * pi * n / std::numbers::phi;
    visit(center[0] + radius * r * std::cos(angle), center[1] + radius * r * std::sin(angle), center[2] + radius * z);
  }
}

/// Calls visit(x, y, z) for points of the faces of a box, the centers of squares.
template <class Visit>
void for_each_point_of_box(const CGAL::Bbox_3& box, double spacing, const Visit& visit) {
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    const double width = box.max(b) - box.min(b), height = box.max(c) - box.min(c);
    const double columns = std::ceil(width / spacing), rows = std::ceil(height / spacing);
    for (double i = 0; i < columns; ++i)
      for (double j = 0; j < rows; ++j)
        for (const double at : {box.min(a), box.max(a)}) {
          std::array<double, 3> p;
          p[std::size_t(a)] = at;
          p[std::size_t(b)] = box.min(b) + width * (i + 0.5) / columns;
          p[std::size_t(c)] = box.min(c) + height * (j + 0.5) / rows;
          visit(p[0], p[1], p[2]);
        }
  }
}

/// Calls visit(x, y, z) for points of the border of a clip domain, with about `spacing` between neighbors.
template <class Visit>
void for_each_border_point(const Clip_domain_3& domain, double spacing, const Visit& visit) {
  if (domain.is_ball()) for_each_point_of_sphere(domain.center(), domain.radius(), spacing, visit);
  else for_each_point_of_box(domain.bbox(), spacing, visit);
}

} // namespace equiaffine::internal

#endif
