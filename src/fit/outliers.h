// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_OUTLIERS_H
#define EQUIAFFINE_SRC_FIT_OUTLIERS_H

#include "fit/Data_points_3.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// The mean of the neighbors of a point.
inline Eigen::Vector3d mean_of_neighbors(const Data_points_3& data, Data_points_3::Index i) {
  const auto around = data.neighbors_of(i);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto j : around) mean += data.points[j] / double(around.size());
  return mean;
}

/// Whether a point is an outlier: away from the mean of its neighbors and theirs by more than 1.5 times their mean distance
/// from it, and from each neighbor by more than 1.5 times the median distance between these and theirs. A corner of a
/// solid, the apex of a flat cone, the center of a fan of long triangles and a point at a border are none.
inline bool is_outlier(const Data_points_3& data, Data_points_3::Index i) {
  constexpr double much = 1.5;
  constexpr std::size_t enough = 3; // neighbors
  const auto& points = data.points;
  std::vector<Data_points_3::Index> around(data.neighbors_of(i).begin(), data.neighbors_of(i).end());
  if (around.size() < enough) return false;
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<double> distances;
  for (const auto j : data.neighbors_of(i)) {
    nearest = std::min(nearest, (points[j] - points[i]).norm());
    for (const auto k : data.neighbors_of(j)) {
      if (k == i) continue;
      distances.push_back((points[j] - points[k]).norm());
      around.push_back(k);
    }
  }
  if (distances.empty()) return false;
  const auto median = distances.begin() + std::ptrdiff_t(distances.size() / 2);
  std::nth_element(distances.begin(), median, distances.end());
  if (!(nearest > much * *median)) return false;
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto j : around) mean += points[j] / double(around.size());
  double radius = 0;
  for (const auto j : around) radius += (points[j] - mean).norm() / double(around.size());
  return (points[i] - mean).norm() > much * radius;
}

/// One flag for each point.
inline std::vector<char> outliers(const Data_points_3& data) {
  std::vector<char> result(data.size());
  for (std::size_t i = 0; i < data.size(); ++i) result[i] = is_outlier(data, Data_points_3::Index(i));
  return result;
}

/// Leaves the edges between points that are no outliers, and returns whether there were others. Points without neighbors
/// get no fit and count in none.
inline bool drop_outliers(const std::vector<char>& is_outlier, std::vector<Data_points_3::Edge>& edges) {
  return std::erase_if(edges, [&](const auto& edge) {
           const auto is_one = [&](Data_points_3::Index i) { return i < is_outlier.size() && is_outlier[i]; };
           return is_one(edge.first) || is_one(edge.second);
         }) > 0;
}

} // namespace equiaffine::internal

#endif
