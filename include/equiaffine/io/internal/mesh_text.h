// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_IO_INTERNAL_MESH_TEXT_H
#define EQUIAFFINE_IO_INTERNAL_MESH_TEXT_H

#include <equiaffine/io/internal/buffered_output.h>

#include <CGAL/number_utils.h>

#include <array>
#include <string_view>

// The library defines the functions that have no body here.
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility push(default)
#endif
namespace equiaffine::internal {

/// The coordinates of a point as they are written.
template <class Point_3>
std::array<double, 3> coordinates(const Point_3& p) {
  return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
}

/// Writes a keyword and three numbers as a line.
void write_line(Buffered_output& out, std::string_view keyword, const std::array<double, 3>& numbers);

/// The unit normal of a triangle, or zero if it has none.
std::array<double, 3> unit_normal(const std::array<std::array<double, 3>, 3>& corners);

} // namespace equiaffine::internal
#ifdef EQUIAFFINE_SHARED
#pragma GCC visibility pop
#endif

#endif
