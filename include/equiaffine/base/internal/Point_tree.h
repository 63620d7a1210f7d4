// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_POINT_TREE_H
#define EQUIAFFINE_BASE_INTERNAL_POINT_TREE_H

#include <Eigen/Core>
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/cartesian/distance_pythagoras_box_box.hpp>
#include <boost/geometry/strategies/cartesian/distance_pythagoras_point_box.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine {

/// A spatial index of vectors with their indices, for nearest-neighbor queries (Boost's R-tree).
template <int Dimension, class Index = std::size_t>
class Point_tree {
public:
  using Vector = Eigen::Matrix<double, Dimension, 1>;
  struct Neighbor {
    Index index;
    double distance;
  };

  Point_tree() = default;

  /// Inserts the vectors; each has its position as index.
  explicit Point_tree(const std::vector<Vector>& vectors)
      : tree_(values(vectors.size(), [&](std::size_t i) { return Value(tree_point(vectors[i]), Index(i)); })) {}

  /// Inserts the vector f(i) for every i in `indices`, with index i.
  template <class F>
  Point_tree(const std::vector<Index>& indices, F f)
      : tree_(values(indices.size(), [&](std::size_t n) { return Value(tree_point(f(indices[n])), indices[n]); })) {}

  /// Returns the `count` nearest vectors, nearest first.
  std::vector<Neighbor> neighbors(const Vector& x, std::size_t count) const {
    const Point p = tree_point(x);
    std::vector<Neighbor> result;
    for_each_nearest(p, count, [&](const Value& value) {
      result.push_back({value.second, boost::geometry::distance(value.first, p)});
    });
    return result;
  }

  /// Returns the indices of the `count` nearest vectors, nearest first.
  std::vector<Index> nearest(const Vector& x, std::size_t count) const {
    std::vector<Index> result;
    for_each_nearest(tree_point(x), count, [&](const Value& value) { result.push_back(value.second); });
    return result;
  }

  /// Calls f(i) for every vector i in the cube with the given center.
  template <class F>
  void for_each_in_cube(const Vector& center, double half_width, F f) const {
    const Vector half = Vector::Constant(half_width);
    const boost::geometry::model::box<Point> cube(tree_point(center - half), tree_point(center + half));
    tree_.query(boost::geometry::index::intersects(cube),
                boost::make_function_output_iterator([&](const Value& value) { f(value.second); }));
  }

private:
  using Point = boost::geometry::model::point<double, Dimension, boost::geometry::cs::cartesian>;
  using Value = std::pair<Point, Index>;
  using Tree = boost::geometry::index::rtree<Value, boost::geometry::index::linear<8>>;

  template <class Make>
  static std::vector<Value> values(std::size_t count, const Make& make) {
    std::vector<Value> result;
    result.reserve(count);
    for (std::size_t n = 0; n < count; ++n) result.push_back(make(n));
    return result;
  }

  template <class Visit>
  void for_each_nearest(const Point& p, std::size_t count, const Visit& visit) const {
    for (auto it = tree_.qbegin(boost::geometry::index::nearest(p, unsigned(count))); it != tree_.qend(); ++it)
      visit(*it);
  }

  static Point tree_point(const Vector& x) {
    Point p;
    set_coordinates(p, x, std::make_integer_sequence<std::size_t, std::size_t(Dimension)>());
    return p;
  }

  template <std::size_t... I>
  static void set_coordinates(Point& p, const Vector& x, std::index_sequence<I...>) {
    (boost::geometry::set<I>(p, x[Eigen::Index(I)]), ...);
  }

  Tree tree_;
};

} // namespace equiaffine

#endif
