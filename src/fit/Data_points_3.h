// SPDX-License-Identifier: GPL-3.0-or-later
// The points to fit, with normals and neighbors, searches among them, and normalized coordinates.
#ifndef EQUIAFFINE_SRC_FIT_DATA_POINTS_3_H
#define EQUIAFFINE_SRC_FIT_DATA_POINTS_3_H

#include <equiaffine/base/internal/Point_tree.h>
#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/fit/internal/Charts_3.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/cartesian/distance_pythagoras_box_box.hpp>
#include <boost/geometry/strategies/cartesian/distance_pythagoras_point_box.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Points of a surface with unit normals and a neighborhood graph.
struct Data_points_3 {
  using Vector = Eigen::Vector3d;
  using Index = std::uint32_t;
  using Edge = std::pair<Index, Index>;

  std::vector<Vector> points, normals;
  std::vector<std::size_t> first_neighbor; ///< one per point, and one more
  std::vector<Index> neighbors;
  std::vector<double> spacing;    ///< typical distance of neighbors around a point
  Charts_3 charts;                ///< parts between creases
  std::vector<char> is_at_border; ///< per point, whether it is within a spacing of the border; empty if unknown, as
                                  ///< without faces

  std::size_t size() const { return points.size(); }
  std::span<const Index> neighbors_of(Index i) const {
    return std::span(neighbors).subspan(first_neighbor[i], first_neighbor[i + 1] - first_neighbor[i]);
  }
};

/// Sets the neighbors from edges, which may occur several times and in both directions.
inline void set_neighbors(Data_points_3& data, std::vector<Data_points_3::Edge> edges) {
  const std::size_t count = edges.size();
  for (std::size_t e = 0; e < count; ++e) edges.emplace_back(edges[e].second, edges[e].first);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::erase_if(edges, [](const auto& edge) { return edge.first == edge.second; });
  data.first_neighbor.assign(data.size() + 1, 0);
  data.neighbors.clear();
  for (const auto& [from, to] : edges) {
    ++data.first_neighbor[from + 1];
    data.neighbors.push_back(to);
  }
  for (std::size_t i = 0; i < data.size(); ++i) data.first_neighbor[i + 1] += data.first_neighbor[i];
}

/// Sets the spacing to `factor` times the mean distance to the neighbors, averaged over the points within six steps,
/// so that it changes gradually.
inline void set_spacing(Data_points_3& data, double factor) {
  data.spacing.assign(data.size(), 0);
  for (std::size_t i = 0; i < data.size(); ++i) {
    const auto around = data.neighbors_of(Data_points_3::Index(i));
    for (const auto j : around)
      data.spacing[i] += factor * (data.points[j] - data.points[i]).norm() / double(around.size());
  }
  for (int round = 0; round < 6; ++round) {
    const std::vector<double> before = data.spacing;
    for (std::size_t i = 0; i < data.size(); ++i) {
      const auto around = data.neighbors_of(Data_points_3::Index(i));
      for (const auto j : around) data.spacing[i] += before[j];
      data.spacing[i] /= double(1 + around.size());
    }
  }
}

template <class T>
std::vector<T> elements_at(const std::vector<T>& elements, const std::vector<Data_points_3::Index>& positions) {
  std::vector<T> result;
  result.reserve(positions.size());
  for (const auto i : positions) result.push_back(elements[i]);
  return result;
}

/// The points that a search has visited. Each thread reuses one array, because a search visits few of the points.
class Visited_points {
public:
  explicit Visited_points(std::size_t size) {
    if (marks_.size() < size) marks_.resize(size, 0);
    if (++now_ != 0) return;
    std::fill(marks_.begin(), marks_.end(), 0);
    now_ = 1;
  }

  /// Returns whether this is the first visit.
  bool insert(Data_points_3::Index i) { return std::exchange(marks_[i], now_) != now_; }

private:
  static inline thread_local std::vector<std::uint32_t> marks_;
  static inline thread_local std::uint32_t now_ = 0;
};

/// Returns the points in the ball around point `center` that are connected with it inside the ball, the center
/// first. This excludes another sheet of the surface close by. The search does not pass points where `admits(i)` is
/// false.
template <class Admits>
std::vector<Data_points_3::Index> connected_ball(const Data_points_3& data, Data_points_3::Index center, double radius,
                                                 Admits admits) {
  std::vector<Data_points_3::Index> ball = {center};
  Visited_points visited(data.size());
  visited.insert(center);
  for (std::size_t k = 0; k < ball.size(); ++k)
    for (const auto j : data.neighbors_of(ball[k]))
      if (visited.insert(j) && (data.points[j] - data.points[center]).squaredNorm() < radius * radius && admits(j))
        ball.push_back(j);
  return ball;
}

inline std::vector<Data_points_3::Index> connected_ball(const Data_points_3& data, Data_points_3::Index center,
                                                        double radius) {
  return connected_ball(data, center, radius, [](Data_points_3::Index) { return true; });
}

using Point_tree_3 = Point_tree<3, Data_points_3::Index>;

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

  /// Returns whether the bounding box of a ball intersects the box with these corners.
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

/// The affine map to normalized coordinates, in which the edges e between neighbors have no preferred direction: the
/// sum of e e^T is a multiple of the identity, and edges have length 1 on average. An affine image of the points has
/// the same coordinates up to a rotation.
///
/// This uses edges instead of points so that points spread evenly over a surface keep even distances.
struct Normalization_3 {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& p) const { return matrix * (p - origin); }

  Eigen::Vector3d inverse(const Eigen::Vector3d& p) const { return origin + matrix.inverse() * p; }

  /// The scaling of lengths that changes volumes like the map.
  double scale() const { return std::cbrt(matrix.determinant()); }

  /// The factors of lengths in the directions of largest and smallest stretch.
  double greatest_stretch() const { return matrix.operatorNorm(); }
  double least_stretch() const { return 1 / matrix.inverse().operatorNorm(); }
};

/// The symmetric matrix to coordinates in which the sum of e e^T over all edges e of all stars has no preferred
/// direction, and edges have length 1 on average. The stretch of directions in which edges are shorter than in
/// others is limited to a thousand, as for points in a plane.
///
/// An edge counts as at most three times as long as the lower quartile of its star. This bounds the influence of
/// long triangles, as along a cylinder, but keeps that of sparse parts of the data.
inline Eigen::Matrix3d whitening_of(const std::vector<std::vector<Eigen::Vector3d>>& stars) {
  constexpr int steps = 20;
  constexpr double most = 3, least_length = 1e-3;
  Eigen::Matrix3d whitening = Eigen::Matrix3d::Zero(); // all lengths are 0 at first, so no edge is too long
  std::vector<double> lengths;
  for (int step = 0; step < steps; ++step) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double count = 0;
    for (const auto& star : stars) {
      lengths.clear();
      for (const auto& edge : star) lengths.push_back((whitening * edge).norm());
      std::vector<double> sorted = lengths;
      const auto quartile = sorted.begin() + std::ptrdiff_t(sorted.size() / 4);
      std::nth_element(sorted.begin(), quartile, sorted.end());
      for (std::size_t k = 0; k < star.size(); ++k) {
        const double part = lengths[k] > most * *quartile ? most * *quartile / lengths[k] : 1;
        sum += part * part * star[k] * star[k].transpose();
        ++count;
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(3 / count * sum);
    Eigen::Vector3d widths = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
    widths = widths.cwiseMax(least_length * widths.maxCoeff());
    whitening = solver.eigenvectors() * widths.cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
  }
  return whitening;
}

inline Normalization_3 normalization_of(const std::vector<Eigen::Vector3d>& points,
                                        const std::vector<Data_points_3::Edge>& edges) {
  constexpr std::size_t most_stars = 5000;
  Normalization_3 result;
  if (points.empty()) return result;
  for (const auto& p : points) result.origin += p / double(points.size());
  double longest = 0;
  for (const auto& [i, j] : edges) longest = std::max(longest, (points[i] - points[j]).lpNorm<Eigen::Infinity>());
  if (!(longest > 0)) return result;
  std::vector<std::size_t> star_of(points.size(), most_stars);
  const auto centers = random_subset(points.size(), most_stars, 4);
  for (std::size_t k = 0; k < centers.size(); ++k) star_of[centers[k]] = k;
  std::vector<std::vector<Eigen::Vector3d>> stars(centers.size());
  for (const auto& [i, j] : edges) {
    const Eigen::Vector3d edge = (points[i] - points[j]) / longest;
    for (const auto center : {i, j})
      if (star_of[center] < most_stars && !edge.isZero(0)) stars[star_of[center]].push_back(edge);
  }
  std::erase_if(stars, [](const auto& star) { return star.empty(); });
  if (!stars.empty()) result.matrix = whitening_of(stars) / longest;
  return result;
}

/// Data points in normalized coordinates.
struct Normalized_data {
  Data_points_3 data;
  Normalization_3 normalization;
};

} // namespace equiaffine::internal

#endif
