// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_COPY_TO_SOUP_H
#define EQUIAFFINE_MESH_INTERNAL_COPY_TO_SOUP_H

#include <equiaffine/mesh/Isosurface_3.h>
#include <equiaffine/mesh/internal/points_of_range.h>

#include <CGAL/number_utils.h>

#include <cstddef>
#include <type_traits>

namespace equiaffine::internal {

template <class Kernel, class Points, class Triangles>
void copy_to_soup(const Isosurface_3<Kernel>& surface, Points& points, Triangles& triangles) {
  using Point = typename Points::value_type;
  using Triangle = typename Triangles::value_type;
  check_coordinates<Point>();
  const std::size_t before = points.size();
  for (const auto& p : surface.points)
    points.push_back(Point(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())));
  for (const auto& corners : surface.triangles) {
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      using Index = std::decay_t<decltype(triangle[k])>;
      const auto index = static_cast<Index>(before + corners[k]);
      if constexpr (requires { triangle.push_back(index); }) triangle.push_back(index);
      else triangle[k] = index;
    }
    triangles.push_back(triangle);
  }
}

} // namespace equiaffine::internal

#endif
