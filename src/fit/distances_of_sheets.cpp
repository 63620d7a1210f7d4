// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/Data_points_3.h"
#include "fit/Fitted_data_3.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/fit/internal/fits.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_set>
#include <vector>

namespace equiaffine::internal {

namespace {

/// Whether two points are of parts that meet at a crease, or both beside creases of parts that meet the same third one.
bool are_beside_crease(const Data_points_3& data, Data_points_3::Index i, Data_points_3::Index j) {
  const Charts_3& charts = data.charts;
  if (charts.of(i) == charts.of(j)) return false;
  if (charts.bend.contains({charts.of(i), charts.of(j)})) return true;
  return charts.has_crease_at(i) && charts.has_crease_at(j) &&
         charts.relation(charts.of(i), charts.of(j)) != Charts_3::Relation::NONE;
}

} // namespace

std::vector<double> distances_of_sheets(bool in_threads, const Fitted_data_3& fit, double greatest) {
  using Index = Data_points_3::Index;
  const Data_points_3& data = fit.data();
  const Eigen::Matrix3d to_space = fit.normalization().matrix.inverse();
  const Point_tree_3 tree(data.points);
  std::vector<double> distances(data.size(), std::numeric_limits<double>::infinity());
  constexpr double most_spacings = 10; // so that each point asks for a bounded number of others
  const auto measure = [&](std::size_t i) {
    const double limit = std::min(greatest * fit.normalization().greatest_stretch(), most_spacings * data.spacing[i]);
    const double reach = std::hypot(limit, data.spacing[i]);
    const auto ball = connected_ball(data, Index(i), 1.3 * reach);
    const std::unordered_set<Index> connected(ball.begin(), ball.end());
    const Eigen::Vector3d normal = (fit.normalization().matrix.transpose() * data.normals[i]).normalized();
    tree.for_each_in_cube(data.points[i], reach, [&](Index j) {
      if (are_beside_crease(data, Index(i), j)) return;
      const Eigen::Vector3d difference = data.points[j] - data.points[i];
      const double across = (difference - difference.dot(data.normals[i]) * data.normals[i]).norm();
      const bool is_other = data.normals[i].dot(data.normals[j]) < 0 || !connected.contains(j);
      if (is_other && across < data.spacing[i])
        distances[i] = std::min(distances[i], std::abs((to_space * difference).dot(normal)));
    });
  };
  parallel_for(in_threads, 0, data.size(), measure, 64);
  std::erase_if(distances, [&](double distance) { return !(distance < greatest); });
  return distances;
}

} // namespace equiaffine::internal
