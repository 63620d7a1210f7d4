// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_POINT_TREE_3_H
#define EQUIAFFINE_FIT_INTERNAL_POINT_TREE_3_H

#include <equiaffine/fit/internal/Data_points_3.h>

#include <Eigen/Core>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace equiaffine::internal {

using Tree_point_3 = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;

inline Tree_point_3 tree_point(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }

/// Finds the nearest of points.
class Point_tree_3 {
public:
  using Index = Data_points_3::Index;

  Point_tree_3() = default;
  explicit Point_tree_3(const std::vector<Eigen::Vector3d>& points) {
    std::vector<Value> values;
    values.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) values.emplace_back(tree_point(points[i]), Index(i));
    tree_ = Tree(values);
  }

  /// Returns the `count` nearest points, in any order.
  std::vector<Index> nearest(const Eigen::Vector3d& p, std::size_t count) const {
    std::vector<Index> result;
    for (auto it = tree_.qbegin(boost::geometry::index::nearest(tree_point(p), unsigned(count))); it != tree_.qend();
         ++it)
      result.push_back(it->second);
    return result;
  }

  /// Calls f(i) for every point i in the cube about `center`.
  template <class F>
  void for_each_in_cube(const Eigen::Vector3d& center, double half_width, F f) const {
    const Eigen::Vector3d half = Eigen::Vector3d::Constant(half_width);
    const boost::geometry::model::box<Tree_point_3> cube(tree_point(center - half), tree_point(center + half));
    for (auto it = tree_.qbegin(boost::geometry::index::intersects(cube)); it != tree_.qend(); ++it) f(it->second);
  }

private:
  using Value = std::pair<Tree_point_3, Index>;
  using Tree = boost::geometry::index::rtree<Value, boost::geometry::index::linear<8>>;
  Tree tree_;
};

/// Finds the balls that contain a point.
class Ball_tree_3 {
public:
  using Index = Data_points_3::Index;

  Ball_tree_3() = default;
  Ball_tree_3(const std::vector<Eigen::Vector3d>& centers, const std::vector<double>& radii) {
    std::vector<Value> values;
    values.reserve(centers.size());
    for (std::size_t i = 0; i < centers.size(); ++i) {
      const Eigen::Vector3d r = Eigen::Vector3d::Constant(radii[i]);
      values.emplace_back(Box(tree_point(centers[i] - r), tree_point(centers[i] + r)), Index(i));
    }
    tree_ = Tree(values);
  }

  /// Calls f(i) for every ball i whose bounding box contains the point.
  template <class F>
  void for_each_around(const Eigen::Vector3d& p, F f) const {
    for (auto it = tree_.qbegin(boost::geometry::index::intersects(tree_point(p))); it != tree_.qend(); ++it)
      f(it->second);
  }

  /// Returns whether the bounding box of a ball meets the box with these corners.
  bool meets(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) const {
    return tree_.qbegin(boost::geometry::index::intersects(Box(tree_point(lower), tree_point(upper)))) != tree_.qend();
  }

private:
  using Box = boost::geometry::model::box<Tree_point_3>;
  using Value = std::pair<Box, Index>;
  using Tree = boost::geometry::index::rtree<Value, boost::geometry::index::linear<8>>;
  Tree tree_;
};

} // namespace equiaffine::internal

#endif
