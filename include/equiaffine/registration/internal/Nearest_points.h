// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_NEAREST_POINTS_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_NEAREST_POINTS_H

#include <Eigen/Core>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A tree of vectors that finds the nearest ones.
template <int Dimension>
class Nearest_points {
public:
  using Vector = Eigen::Matrix<double, Dimension, 1>;
  struct Neighbor {
    std::size_t index;
    double distance;
  };

  Nearest_points() = default;

  /// Takes the vectors f(i), which keep their numbers i.
  template <class F>
  Nearest_points(const std::vector<std::size_t>& indices, F f) {
    std::vector<Value> values;
    values.reserve(indices.size());
    for (const std::size_t i : indices) values.emplace_back(tree_point(f(i)), i);
    tree_ = Tree(values);
  }

  /// Returns the nearest `count` vectors, the nearest one first.
  std::vector<Neighbor> operator()(const Vector& x, std::size_t count) const {
    const Point p = tree_point(x);
    std::vector<Neighbor> result;
    for (auto it = tree_.qbegin(boost::geometry::index::nearest(p, unsigned(count))); it != tree_.qend(); ++it)
      result.push_back({it->second, boost::geometry::distance(it->first, p)});
    return result;
  }

private:
  using Point = boost::geometry::model::point<double, Dimension, boost::geometry::cs::cartesian>;
  using Value = std::pair<Point, std::size_t>;
  using Tree = boost::geometry::index::rtree<Value, boost::geometry::index::linear<8>>;

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

} // namespace equiaffine::internal

#endif
