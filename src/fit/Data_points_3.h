// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_DATA_POINTS_3_H
#define EQUIAFFINE_SRC_FIT_DATA_POINTS_3_H

#include <equiaffine/fit/internal/Charts_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Points of a surface, with unit normals and the graph that says which are neighbors of each other.
struct Data_points_3 {
  using Vector = Eigen::Vector3d;
  using Index = std::uint32_t;
  using Edge = std::pair<Index, Index>;

  std::vector<Vector> points, normals;
  std::vector<std::size_t> first_neighbor; ///< one for every point, and one more
  std::vector<Index> neighbors;
  std::vector<double> spacing;    ///< the typical distance of neighbors around a point
  Charts_3 charts;                ///< the parts between creases
  std::vector<char> is_at_border; ///< within a spacing of it, for each point; empty if not known, as without faces

  std::size_t size() const { return points.size(); }
  std::span<const Index> neighbors_of(Index i) const {
    return std::span(neighbors).subspan(first_neighbor[i], first_neighbor[i + 1] - first_neighbor[i]);
  }
};

/// Sets the neighbors from edges, each of which may come several times and in both directions.
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

/// Sets the spacing: `factor` times the mean distance to the neighbors, averaged over what can be reached in six steps,
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

/// Which points a search has met. Each thread keeps one, since a search meets few of the points.
class Visited_points {
public:
  explicit Visited_points(std::size_t size) {
    if (marks_.size() < size) marks_.resize(size, 0);
    if (++now_ != 0) return;
    std::fill(marks_.begin(), marks_.end(), 0);
    now_ = 1;
  }

  /// Returns whether this is the first time.
  bool insert(Data_points_3::Index i) { return std::exchange(marks_[i], now_) != now_; }

private:
  static inline thread_local std::vector<std::uint32_t> marks_;
  static inline thread_local std::uint32_t now_ = 0;
};

/// Returns the points in the ball of the given radius around point `center` that are connected with it inside the ball,
/// the center first, so that another sheet of the surface close by does not come in. A point to which `admits(i)` is
/// false blocks the way.
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

} // namespace equiaffine::internal

#endif
