// SPDX-License-Identifier: GPL-3.0-or-later
// Solids with planes, edges and corners for tests of symmetries and of registration.
#ifndef EQUIAFFINE_TEST_SUPPORT_SOLIDS_H
#define EQUIAFFINE_TEST_SUPPORT_SOLIDS_H

#include "support/registration_cases.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>
#include <vector>

namespace solids {

using registration_cases::Map;
using registration_cases::Point_3;

struct Solid {
  std::vector<Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
};

/// A prism over a polygon that is star-shaped from its first corner; the upper polygon is scaled by `part`.
inline Solid prism(const std::vector<std::array<double, 2>>& base, double height, double part = 1) {
  const std::size_t n = base.size();
  Solid solid;
  for (const auto& [x, y] : base) solid.points.emplace_back(x, y, 0);
  for (const auto& [x, y] : base) solid.points.emplace_back(part * x, part * y, height);
  std::vector<std::size_t> top, bottom;
  for (std::size_t i = 0; i < n; ++i) {
    top.push_back(n + i);
    bottom.push_back(i == 0 ? 0 : n - i);
    solid.polygons.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
  }
  solid.polygons.push_back(top);
  solid.polygons.push_back(bottom);
  return solid;
}

/// A prism whose upper polygon is rotated by the fraction `part` of the angle of a side; an antiprism for 1/2.
inline Solid twisted_prism(const std::vector<std::array<double, 2>>& base, double height, double part) {
  const std::size_t n = base.size();
  const double turn = 2 * std::numbers::pi * part / double(n), c = std::cos(turn), s = std::sin(turn);
  Solid solid = prism(base, height);
  for (std::size_t i = n; i < 2 * n; ++i) {
    const Point_3 p = solid.points[i];
    solid.points[i] = Point_3(c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z());
  }
  std::erase_if(solid.polygons, [=](const auto& polygon) { return polygon.size() == 4 && n != 4; });
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    solid.polygons.push_back({i, j, n + i});
    solid.polygons.push_back({j, n + j, n + i});
  }
  return solid;
}

inline std::vector<std::array<double, 2>> regular(std::size_t corners) {
  std::vector<std::array<double, 2>> polygon;
  for (std::size_t k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * double(k) / double(corners);
    polygon.push_back({std::cos(angle), std::sin(angle)});
  }
  return polygon;
}

inline Solid box(double a, double b, double c) { return prism({{-a, -b}, {a, -b}, {a, b}, {-a, b}}, 2 * c); }

inline Solid tetrahedron() {
  return {{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A cube of side 2 without a corner, which is cut off at the distance `cut` along its edges.
inline Solid cube_without_corner(double cut) {
  const double c = 1 - cut;
  return {{{-1, -1, -1},
           {1, -1, -1},
           {1, 1, -1},
           {-1, 1, -1},
           {-1, -1, 1},
           {1, -1, 1},
           {-1, 1, 1},
           {1, 1, c},
           {1, c, 1},
           {c, 1, 1}},
          {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 6, 3}, {1, 2, 7, 8, 5}, {2, 3, 6, 9, 7}, {4, 5, 8, 9, 6}, {7, 9, 8}}};
}

inline Solid moved(Solid solid, const Map& map) {
  for (Point_3& p : solid.points) p = map(p);
  return solid;
}

/// An L with legs of different lengths. If tapered, it has no symmetries.
inline Solid L(double part = 1) { return prism({{.4, .4}, {.4, 1.5}, {0, 1.5}, {0, 0}, {1, 0}, {1, .4}}, .5, part); }

/// The part of a surface on the negative side of a plane with this normal direction, without the section.
inline Solid clipped(const Solid& solid, const Point_3::R::Vector_3& direction, double limit) {
  Solid result;
  const auto height = [&](std::size_t i) { return direction * (solid.points[i] - CGAL::ORIGIN) - limit; };
  for (const auto& polygon : solid.polygons)
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const std::array<std::size_t, 3> triangle = {polygon[0], polygon[k - 1], polygon[k]};
      std::vector<std::size_t> part;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t i = triangle[c], j = triangle[(c + 1) % 3];
        const double a = height(i), b = height(j);
        if (a <= 0) part.push_back(result.points.size()), result.points.push_back(solid.points[i]);
        if ((a <= 0) == (b <= 0)) continue;
        part.push_back(result.points.size());
        // Both faces of an edge must compute the same intersection point.
        const auto [p, q, x, y] = i < j ? std::tuple(i, j, a, b) : std::tuple(j, i, b, a);
        result.points.push_back(solid.points[p] + x / (x - y) * (solid.points[q] - solid.points[p]));
      }
      if (part.size() >= 3) result.polygons.push_back(part);
    }
  return result;
}

} // namespace solids

#endif
