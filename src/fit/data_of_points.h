// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_DATA_OF_POINTS_H
#define EQUIAFFINE_SRC_FIT_DATA_OF_POINTS_H

#include "fit/Normalization_3.h"
#include "fit/Point_tree_3.h"
#include "fit/outliers.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/fit/Normal_orientation.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace equiaffine::internal {

constexpr std::size_t number_of_nearest = 16;

/// The length of the edges of a triangulation of equilateral triangles, where 1 is the radius of a disk that has as
/// many points as vertices: the square root of 2 pi / sqrt(3). The mean distance to the n nearest points is 2/3
/// sqrt(n).
constexpr double mesh_edge = 1.9046;

/// Returns the edges from every point to its nearest others.
inline std::vector<Data_points_3::Edge> edges_to_nearest(bool in_threads, const std::vector<Eigen::Vector3d>& points) {
  const Point_tree_3 tree(points);
  std::vector<std::vector<Data_points_3::Index>> nearest(points.size());
  parallel_for(
      in_threads, 0, points.size(), [&](std::size_t i) { nearest[i] = tree.nearest(points[i], number_of_nearest + 1); },
      256);
  std::vector<Data_points_3::Edge> edges;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const auto j : nearest[i])
      if (j != i) edges.emplace_back(Data_points_3::Index(i), j);
  return edges;
}

/// Sets the normals to the directions in which the neighbors are spread the least.
inline void set_normals_by_neighbors(bool in_threads, Data_points_3& data) {
  data.normals.assign(data.size(), Eigen::Vector3d::Zero());
  parallel_for(
      in_threads, 0, data.size(),
      [&](std::size_t i) {
        const auto around = data.neighbors_of(Data_points_3::Index(i));
        Eigen::Vector3d mean = data.points[i];
        for (const auto j : around) mean += data.points[j];
        mean /= double(around.size() + 1);
        Eigen::Matrix3d spread = (data.points[i] - mean) * (data.points[i] - mean).transpose();
        for (const auto j : around) spread += (data.points[j] - mean) * (data.points[j] - mean).transpose();
        data.normals[i] = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
      },
      256);
}

/// Turns normals so that those of neighbors agree, along a spanning tree of least differences of direction for each
/// component, from its highest point, whose normal points up (Hoppe et al. 1992, section 3.3).
inline void orient_normals(Data_points_3& data) {
  using Index = Data_points_3::Index;
  std::vector<Index> highest_first(data.size());
  std::iota(highest_first.begin(), highest_first.end(), Index(0));
  std::stable_sort(highest_first.begin(), highest_first.end(),
                   [&](Index i, Index j) { return data.points[i][2] > data.points[j][2]; });
  std::vector<bool> is_oriented(data.size());
  using Step = std::tuple<double, Index, Index>; // the difference, the point, the one it is reached from
  std::priority_queue<Step, std::vector<Step>, std::greater<Step>> steps;
  for (const Index start : highest_first) {
    if (is_oriented[start]) continue;
    if (data.normals[start][2] < 0) data.normals[start] *= -1;
    steps.emplace(0., start, start);
    while (!steps.empty()) {
      const auto [difference, i, from] = steps.top();
      steps.pop();
      if (is_oriented[i]) continue;
      is_oriented[i] = true;
      if (data.normals[i].dot(data.normals[from]) < 0) data.normals[i] *= -1;
      for (const Index j : data.neighbors_of(i))
        if (!is_oriented[j]) steps.emplace(1 - std::abs(data.normals[i].dot(data.normals[j])), j, i);
    }
  }
}

/// Points without faces, all different. Neighbors are the nearest points, first as they are given and then in the
/// coordinates in which the edges found at first have no preferred direction. Outliers have no neighbors. Normals that
/// are not given are estimated.
inline Normalized_data data_of_points(bool in_threads, const std::vector<Eigen::Vector3d>& points,
                                      const std::vector<Eigen::Vector3d>& normals = {},
                                      Normal_orientation orientation = Normal_orientation::UNORIENTED) {
  Normalized_data result;
  Data_points_3& data = result.data;
  result.normalization = normalization_of(points, edges_to_nearest(in_threads, points));
  for (const auto& p : points) data.points.push_back(result.normalization(p));
  std::vector<Data_points_3::Edge> edges = edges_to_nearest(in_threads, data.points);
  set_neighbors(data, edges);
  if (drop_outliers(outliers(data), edges)) set_neighbors(data, std::move(edges));
  set_spacing(data, mesh_edge / (2. / 3 * std::sqrt(double(number_of_nearest))));
  if (normals.empty()) set_normals_by_neighbors(in_threads, data);
  else {
    const Eigen::Matrix3d inverse_transpose = result.normalization.matrix.inverse().transpose();
    for (const auto& normal : normals) data.normals.push_back((inverse_transpose * normal).normalized());
  }
  if (normals.empty() || orientation == Normal_orientation::UNORIENTED) orient_normals(data);
  return result;
}

} // namespace equiaffine::internal

#endif
