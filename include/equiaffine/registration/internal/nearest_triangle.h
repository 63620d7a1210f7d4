// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_NEAREST_TRIANGLE_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_NEAREST_TRIANGLE_H

#include <equiaffine/volume/Triangle_tree.h>

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace equiaffine::internal {

/// The point of a tree's triangles that is nearest to another point.
struct Nearest_triangle {
  Triangle_tree::Part part = 0; ///< the triangle
  Distance_kernel::Point_3 point;
  double squared_distance = std::numeric_limits<double>::infinity();
};

/// Finds the nearest triangle, by the nearer one of two children first. The depth of a tree that is halved by medians
/// is below 64.
/// \pre the tree has at least two triangles.
inline Nearest_triangle nearest_triangle(const Triangle_tree& tree, const Distance_kernel::Point_3& p) {
  Nearest_triangle best;
  const auto try_triangle = [&](Triangle_tree::Part part, const Distance_kernel::Point_3& q, double d) {
    if (d < best.squared_distance) best = {part, q, d};
  };
  std::array<std::pair<Triangle_tree::Part, double>, 128> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0.0};
  while (size > 0) {
    const auto [box, box_distance] = stack[--size];
    if (box_distance >= best.squared_distance) continue;
    std::array<std::pair<Triangle_tree::Part, double>, 2> open;
    std::size_t count = 0;
    for (const Triangle_tree::Part child : tree.children(box)) {
      const auto q = tree.nearest_point(child, p);
      const double d = (p - q).squared_length();
      if (Triangle_tree::is_triangle(child)) try_triangle(child, q, d);
      else open[count++] = {child, d};
    }
    if (count == 2 && open[0].second < open[1].second) std::swap(open[0], open[1]);
    for (std::size_t i = 0; i < count; ++i)
      if (open[i].second < best.squared_distance) stack[size++] = open[i];
  }
  return best;
}

} // namespace equiaffine::internal

#endif
