// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_MESH_TEXT_H
#define EQUIAFFINE_IO_INTERNAL_MESH_TEXT_H

#include <equiaffine/io/internal/buffered_output.h>

#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

namespace equiaffine::internal {

/// The coordinates of a point as they are written.
template <class Point_3>
std::array<double, 3> coordinates(const Point_3& p) {
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

/// Writes a keyword and three numbers as a line.
inline void write_line(Buffered_output& out, std::string_view keyword, const std::array<double, 3>& numbers) {
  out << keyword << numbers[0] << ' ' << numbers[1] << ' ' << numbers[2] << '\n';
}

/// The unit normal of a triangle, or zero if it has none.
inline std::array<double, 3> unit_normal(const std::array<std::array<double, 3>, 3>& corners) {
  std::array<double, 3> u{}, v{}, normal{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = corners[1][i] - corners[0][i];
    v[i] = corners[2][i] - corners[0][i];
  }
  for (std::size_t i = 0; i < 3; ++i) normal[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  for (double& component : normal) component = length > 0 ? component / length : 0;
  return normal;
}

} // namespace equiaffine::internal

#endif
