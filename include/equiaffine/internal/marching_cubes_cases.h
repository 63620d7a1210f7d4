// SPDX-License-Identifier: GPL-3.0-or-later
// The triangles of every sign pattern of a cell, made from one rule for faces: positive corners that face each other
// diagonally are separated. The rule reads nothing but the signs on the face, so the cells on both sides agree.
#ifndef EQUIAFFINE_INTERNAL_MARCHING_CUBES_CASES_H
#define EQUIAFFINE_INTERNAL_MARCHING_CUBES_CASES_H

#include <CGAL/assertions.h>
#include <CGAL/use.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 axis + p + 2 q runs along `axis`; p and q are its
/// coordinates along the next two axes, cyclically. Bit c of a case says that corner c is positive.
class Marching_cubes_cases {
public:
  using Triangle = std::array<std::uint8_t, 3>; ///< three edges, counterclockwise seen from the positive side

  static const Marching_cubes_cases& instance() {
    static const Marching_cubes_cases cases;
    return cases;
  }

  const std::vector<Triangle>& operator[](std::size_t signs) const { return triangles_[signs]; }

  /// The corner at which an edge begins.
  static constexpr int first_corner(int edge) {
    const int axis = edge / 4;
    return (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
  }

private:
  using Loop = std::vector<int>; // edges whose crossings bound one piece of the surface

  Marching_cubes_cases() {
    for (unsigned signs = 0; signs < 256; ++signs)
      for (const Loop& loop : loops(signs)) {
        const bool has_triangulation = triangulate(loop, triangles_[signs]);
        CGAL_assertion(has_triangulation);
        CGAL_USE(has_triangulation);
      }
  }

  static int edge_between(int corner, int other) {
    const int axis = (corner ^ other) == 1 ? 0 : (corner ^ other) == 2 ? 1 : 2;
    return 4 * axis + (corner >> (axis + 1) % 3 & 1) + 2 * (corner >> (axis + 2) % 3 & 1);
  }

  /// The corners of face `side` of `axis`, counterclockwise seen from outside.
  static std::array<int, 4> face(int axis, int side) {
    const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = side << axis;
    return side ? std::array{base, base + u, base + u + v, base + v}
                : std::array{base, base + v, base + u + v, base + u};
  }

  /// On each face every run of positive corners is cut off by a segment from the edge after the run to the one before
  /// it. The next face traverses an edge the other way round, so the segments of all faces form closed loops.
  static std::vector<Loop> loops(unsigned signs) {
    const auto is_positive = [&](int corner) { return (signs >> corner & 1) != 0; };
    std::array<int, 12> next;
    next.fill(-1);
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        const auto corners = face(axis, side);
        for (std::size_t m = 0; m < 4; ++m) {
          if (is_positive(corners[m]) || !is_positive(corners[(m + 1) % 4])) continue;
          std::size_t last = m + 1;
          while (is_positive(corners[(last + 1) % 4])) ++last;
          next[std::size_t(edge_between(corners[last % 4], corners[(last + 1) % 4]))] =
              edge_between(corners[m], corners[(m + 1) % 4]);
        }
      }
    std::vector<Loop> result;
    for (int first = 0; first < 12; ++first) {
      Loop loop;
      for (int edge = first; next[std::size_t(edge)] >= 0;) {
        loop.push_back(edge);
        const int following = next[std::size_t(edge)];
        next[std::size_t(edge)] = -1;
        edge = following;
      }
      if (!loop.empty()) result.push_back(loop);
    }
    return result;
  }

  static bool share_face(int e, int f) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto side = [&](int edge) { return edge / 4 == axis ? -1 : first_corner(edge) >> axis & 1; };
      if (side(e) >= 0 && side(e) == side(f)) return true;
    }
    return false;
  }

  /// Appends a triangulation of a loop without diagonals in a face of the cell, where the next cell could have the same
  /// diagonal and the edge would get four triangles.
  static bool triangulate(const Loop& loop, std::vector<Triangle>& triangles) {
    if (loop.size() < 3) return true;
    const auto may_join = [&](std::size_t i, std::size_t j) {
      const bool are_neighbours = j == i + 1 || (i == 0 && j + 1 == loop.size());
      return are_neighbours || !share_face(loop[i], loop[j]);
    };
    for (std::size_t apex = 1; apex + 1 < loop.size(); ++apex) {
      if (!may_join(0, apex) || !may_join(apex, loop.size() - 1)) continue;
      const std::size_t size = triangles.size();
      triangles.push_back({std::uint8_t(loop[0]), std::uint8_t(loop[apex]), std::uint8_t(loop.back())});
      const auto at = [&](std::size_t n) { return loop.begin() + std::ptrdiff_t(n); };
      if (triangulate(Loop(at(0), at(apex + 1)), triangles) && triangulate(Loop(at(apex), loop.end()), triangles))
        return true;
      triangles.resize(size);
    }
    return false;
  }

  std::array<std::vector<Triangle>, 256> triangles_;
};

} // namespace equiaffine::internal

#endif
