// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_BALL_TREE_3_H
#define EQUIAFFINE_SRC_FIT_BALL_TREE_3_H

#include "fit/Data_points_3.h"

#include <Eigen/Core>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/cartesian/distance_pythagoras_box_box.hpp>
#include <boost/geometry/strategies/cartesian/distance_pythagoras_point_box.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

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
      values.emplace_back(Box(corner(centers[i] - r), corner(centers[i] + r)), Index(i));
    }
    tree_ = Tree(values);
  }

  /// Calls f(i) for every ball i whose bounding box contains the point.
  template <class F>
  void for_each_around(const Eigen::Vector3d& p, F f) const {
    for (auto it = tree_.qbegin(boost::geometry::index::intersects(corner(p))); it != tree_.qend(); ++it) f(it->second);
  }

  /// Returns whether the bounding box of a ball meets the box with these corners.
  bool meets(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) const {
    return tree_.qbegin(boost::geometry::index::intersects(Box(corner(lower), corner(upper)))) != tree_.qend();
  }

private:
  using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Box = boost::geometry::model::box<Corner>;
  using Value = std::pair<Box, Index>;
  using Tree = boost::geometry::index::rtree<Value, boost::geometry::index::linear<8>>;

  static Corner corner(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }

  Tree tree_;
};

} // namespace equiaffine::internal

#endif
