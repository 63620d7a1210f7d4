// SPDX-License-Identifier: GPL-3.0-or-later
// The curves in which a surface meets the faces of a cell, and the triangles between these curves. No edge inside a
// cell joins two points of the same face: the next cell could have the same edge, which would then be in four
// triangles.
#ifndef EQUIAFFINE_MARCHING_CUBES_INTERNAL_CELL_POLYGONS_H
#define EQUIAFFINE_MARCHING_CUBES_INTERNAL_CELL_POLYGONS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 axis + p + 2 q runs along `axis`; p and q are its
// coordinates along the next two axes, cyclically. Face 2 axis + side lies where the coordinate along `axis` is `side`.

/// The corner at which an edge begins, and the one at which it ends.
constexpr int first_corner(int edge) {
  const int axis = edge / 4;
  return (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
}
constexpr int second_corner(int edge) { return first_corner(edge) | 1 << edge / 4; }

/// The edge between two corners.
constexpr int edge_between(int corner, int other) {
  const int axis = (corner ^ other) == 1 ? 0 : (corner ^ other) == 2 ? 1 : 2;
  return 4 * axis + (corner >> (axis + 1) % 3 & 1) + 2 * (corner >> (axis + 2) % 3 & 1);
}

/// The corners of a face, counterclockwise seen from outside.
constexpr std::array<int, 4> face_corners(int face) {
  const int axis = face / 2, side = face % 2;
  const int base = side << axis, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
  return side ? std::array{base, base | u, base | u | v, base | v} : std::array{base, base | v, base | u | v, base | u};
}

/// Whether two edges lie in one face.
constexpr bool share_face(int edge, int other) {
  for (int axis = 0; axis < 3; ++axis)
    if (edge / 4 != axis && other / 4 != axis && ((first_corner(edge) ^ first_corner(other)) >> axis & 1) == 0)
      return true;
  return false;
}

/// A closed curve through points on edges of the cell.
using Polygon = std::vector<std::uint8_t>;

/// The boundary curves of the surface in a cell. Corner c is positive if bit c of `signs` is set, and the positive
/// corners of a face are joined if its bit in `joined` is set. On each face a segment leads from the edge after a run
/// of positive corners to the edge before it or, if the positive corners are joined, to the edge before the next run.
/// The face on the other side of an edge traverses the edge the other way round, so the segments of all faces form
/// closed curves.
inline std::vector<Polygon> boundary_curves(unsigned signs, unsigned joined) {
  const auto is_positive = [&](int corner) { return (signs >> corner & 1) != 0; };
  std::array<int, 12> next;
  next.fill(-1);
  for (int face = 0; face < 6; ++face) {
    const auto corners = face_corners(face);
    const auto corner = [&](std::size_t m) { return corners[m % 4]; };
    for (std::size_t m = 0; m < 4; ++m) {
      if (!is_positive(corner(m)) || is_positive(corner(m + 1))) continue;
      std::size_t end = m; // the segment ends where corner(end) is negative and corner(end + 1) positive
      if (joined >> face & 1) {
        for (end = m + 1; !is_positive(corner(end + 1));) ++end;
      } else {
        for (end = m + 3; is_positive(corner(end));) end += 3;
      }
      next[std::size_t(edge_between(corner(m), corner(m + 1)))] = edge_between(corner(end), corner(end + 1));
    }
  }
  std::vector<Polygon> curves;
  for (std::size_t first = 0; first < 12; ++first) {
    Polygon curve;
    for (std::size_t edge = first; next[edge] >= 0;) {
      curve.push_back(std::uint8_t(edge));
      edge = std::size_t(std::exchange(next[edge], -1));
    }
    if (!curve.empty()) curves.push_back(curve);
  }
  return curves;
}

/// Appends a triangulation of a polygon without inner vertices. Returns false if there is none.
inline bool triangulate_disc(const Polygon& polygon, std::vector<std::array<std::uint8_t, 3>>& triangles) {
  const std::size_t n = polygon.size();
  if (n < 3) return true;
  const auto may_join = [&](std::size_t i, std::size_t j) {
    return j == i + 1 || (i == 0 && j + 1 == n) || !share_face(polygon[i], polygon[j]);
  };
  for (std::size_t apex = 1; apex + 1 < n; ++apex) {
    if (!may_join(0, apex) || !may_join(apex, n - 1)) continue;
    const std::size_t size = triangles.size();
    triangles.push_back({polygon[0], polygon[apex], polygon.back()});
    const auto at = polygon.begin() + std::ptrdiff_t(apex);
    if (triangulate_disc(Polygon(polygon.begin(), at + 1), triangles) &&
        triangulate_disc(Polygon(at, polygon.end()), triangles))
      return true;
    triangles.resize(size);
  }
  return false;
}

/// The squared distance between the midpoints of two edges of a cell whose edges have length 2.
inline int squared_distance(int edge, int other) {
  int sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = [&](int e) { return e / 4 == axis ? 1 : 2 * (first_corner(e) >> axis & 1); };
    const int d = coordinate(edge) - coordinate(other);
    sum += d * d;
  }
  return sum;
}

/// Appends the triangles of an annulus between two curves. In most cases edges between the curves are not enough, so a
/// ring of three inner vertices first, first + 1, first + 2 lies between the curves. Each is joined to an arc of either
/// curve, and the vertices of its two arcs are appended to `arcs`. The ring runs along a and against b, since the
/// boundaries of an annulus run in opposite directions.
inline void triangulate_annulus(const Polygon& a, const Polygon& b, std::uint8_t first,
                                std::vector<std::array<std::uint8_t, 3>>& triangles, std::vector<Polygon>& arcs) {
  const auto arc = [](const Polygon& curve, std::size_t offset, std::size_t m) {
    Polygon result;
    for (std::size_t i = m * curve.size() / 3; i <= (m + 1) * curve.size() / 3; ++i)
      result.push_back(curve[(offset + i) % curve.size()]);
    return result;
  };
  std::size_t best_offset = 0;
  int best_length = std::numeric_limits<int>::max();
  for (std::size_t offset = 0; offset < b.size(); ++offset) {
    int length = 0;
    for (std::size_t m = 0; m < 3; ++m)
      for (const auto p : arc(a, 0, m))
        for (const auto q : arc(b, offset, 2 - m)) length += squared_distance(p, q);
    if (length < best_length) best_offset = offset, best_length = length;
  }
  const auto add_side = [&](const Polygon& side, std::uint8_t here, std::uint8_t next) {
    for (std::size_t i = 0; i + 1 < side.size(); ++i) triangles.push_back({side[i], side[i + 1], here});
    triangles.push_back({side.back(), next, here});
  };
  for (std::uint8_t m = 0; m < 3; ++m) {
    Polygon both = arc(a, 0, m);
    const Polygon side_b = arc(b, best_offset, 2U - m);
    add_side(both, std::uint8_t(first + m), std::uint8_t(first + (m + 1) % 3));
    add_side(side_b, std::uint8_t(first + m), std::uint8_t(first + (m + 2) % 3));
    both.insert(both.end(), side_b.begin(), side_b.end());
    arcs.push_back(both);
  }
}

} // namespace equiaffine::internal

#endif
