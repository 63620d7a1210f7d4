// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_NEAREST_TRIANGLE_H
#define EQUIAFFINE_SRC_REGISTRATION_NEAREST_TRIANGLE_H

#include "registration/mesh_samples.h"
#include <equiaffine/volume/internal/Triangle_tree.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

inline Distance_kernel::Point_3 to_CGAL(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }
inline Eigen::Vector3d to_Eigen(const Distance_kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

/// A tree of triangles, which is to have two of them at least.
inline Triangle_tree tree_of(std::vector<Triangle_tree::Triangle_3> triangles) {
  if (triangles.size() == 1) triangles.push_back(triangles.front());
  return Triangle_tree(std::move(triangles), 0);
}

/// The triangles that have an area beside the largest one, since others have no normal.
/// \pre the mesh has an area.
inline std::vector<Triangle_tree::Triangle_3> triangles_with_area(const Triangles_3& mesh) {
  constexpr double rounding = 1e-14;
  double greatest = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) greatest = std::max(greatest, mesh.double_area(t).norm());
  std::vector<Triangle_tree::Triangle_3> result;
  result.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (mesh.double_area(t).norm() > rounding * greatest)
      result.emplace_back(to_CGAL(mesh.corner(t, 0)), to_CGAL(mesh.corner(t, 1)), to_CGAL(mesh.corner(t, 2)));
  return result;
}

inline Eigen::Vector3d unit_normal(const Triangle_tree::Triangle_3& t) {
  const Eigen::Vector3d a = to_Eigen(t[0]);
  return (to_Eigen(t[1]) - a).cross(to_Eigen(t[2]) - a).normalized();
}

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
