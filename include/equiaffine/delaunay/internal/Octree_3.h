// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_DELAUNAY_INTERNAL_OCTREE_3_H
#define EQUIAFFINE_DELAUNAY_INTERNAL_OCTREE_3_H

#include <CGAL/Bbox_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace equiaffine::internal {

/// Computes the places of the cells of an octree. The root, at level 0, is a cube that contains a box and has its lower
/// corner in common with it. The cells of level n have sides 2^n times smaller, and are cut off where the box ends.
class Octree_3 {
public:
  using Position = std::array<std::uint32_t, 3>; ///< number of the cell of its level along x, y and z

  explicit Octree_3(const CGAL::Bbox_3& box) : box_(box), side_(std::max({box.x_span(), box.y_span(), box.z_span()})) {}

  const CGAL::Bbox_3& box() const { return box_; }
  double side(int level) const { return std::ldexp(side_, -level); }

  CGAL::Bbox_3 box_of(const Position& p, int level) const {
    const double h = side(level);
    const auto at = [&](int a, std::uint32_t n) { return std::min(box_.min(a) + n * h, box_.max(a)); };
    return CGAL::Bbox_3(at(0, p[0]), at(1, p[1]), at(2, p[2]), at(0, p[0] + 1), at(1, p[1] + 1), at(2, p[2] + 1));
  }

  /// Calls visit(position) for the children, on the next level, of a cell of a level; those outside of the box are left
  /// out.
  template <class Visit>
  void for_each_child(const Position& parent, int level, const Visit& visit) const {
    const double h = side(level) / 2;
    for (std::uint32_t c = 0; c < 8; ++c) {
      Position child;
      bool is_in_box = true;
      for (std::uint32_t a = 0; a < 3; ++a) {
        child[a] = 2 * parent[a] + (c >> a & 1);
        is_in_box = is_in_box && (box_.min(int(a)) + child[a] * h < box_.max(int(a)));
      }
      if (is_in_box) visit(child);
    }
  }

private:
  const CGAL::Bbox_3 box_;
  const double side_;
};

} // namespace equiaffine::internal

#endif
