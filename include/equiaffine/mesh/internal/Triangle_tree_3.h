// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_MESH_INTERNAL_TRIANGLE_TREE_3_H
#define EQUIAFFINE_MESH_INTERNAL_TRIANGLE_TREE_3_H

#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

// CGAL 6 has renamed these headers and classes.
#if __has_include(<CGAL/AABB_traits_3.h>)
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

namespace equiaffine {

/// Finds the triangle nearest to a point. Queries are thread-safe.
class Triangle_tree_3 {
public:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point_3 = Kernel::Point_3;

  /// Builds the tree from triples of indices of points. Degenerate triangles are ignored.
  template <class Points, class Triangles, class To_point>
  Triangle_tree_3(const Points& points, const Triangles& triangles, const To_point& to_point) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      const Kernel::Triangle_3 triangle(to_point(points[a]), to_point(points[b]), to_point(points[c]));
      if (!triangle.is_degenerate()) triangles_.push_back(triangle), numbers_.push_back(t);
    }
    tree_.insert(triangles_.cbegin(), triangles_.cend());
    tree_.build();
    tree_.accelerate_distance_queries();
  }
  Triangle_tree_3(const Triangle_tree_3&) = delete;
  Triangle_tree_3& operator=(const Triangle_tree_3&) = delete;

  /// The distance from a point to the triangles; infinity if there are none.
  double distance(const Point_3& p) const { return is_empty() ? infinity : std::sqrt(tree_.squared_distance(p)); }

  /// The same distance, and the index of the nearest triangle.
  std::pair<double, std::size_t> nearest(const Point_3& p) const {
    if (is_empty()) return {infinity, 0};
    const auto [foot, triangle] = tree_.closest_point_and_primitive(p);
    return {std::sqrt(CGAL::squared_distance(foot, p)), numbers_[std::size_t(triangle - triangles_.cbegin())]};
  }

private:
  using Triangles = std::vector<Kernel::Triangle_3>;
#if __has_include(<CGAL/AABB_traits_3.h>)
  using Traits = CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Triangles::const_iterator>>;
#else
  using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>;
#endif
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  bool is_empty() const { return triangles_.empty(); }

  Triangles triangles_;
  std::vector<std::size_t> numbers_;
  CGAL::AABB_tree<Traits> tree_;
};

} // namespace equiaffine

#endif
