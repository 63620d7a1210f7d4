// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_CENTERED_MAP_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_CENTERED_MAP_H

#include <equiaffine/registration/internal/Centered_surface_3.h>
#include <equiaffine/registration/internal/Rotation_search.h>
#include <equiaffine/registration/internal/refine_map.h>

#include <Eigen/Core>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// A map in the coordinates of a Centered_surface_3, with the rms distance, both ways, between moved points and the
/// surface.
struct Centered_map {
  Affine_map_3 map = {};
  double rms = std::numeric_limits<double>::infinity();
};

inline double difference(const Centered_map& a, const Centered_map& b) {
  return difference(a.map.matrix, b.map.matrix);
}

/// The distances of the first `count` points of a surface: of moved ones, and of the others beside the moved surface.
struct Distances_both_ways {
  std::vector<Mapped_point> moved, fixed;

  Distances_both_ways(const Centered_surface_3& surface, const Affine_map_3& map, std::size_t count) {
    const Affine_map_3 inverse = map.inverse();
    count = std::min(count, surface.samples.points.size());
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d& p = surface.samples.points[i];
      const Eigen::Vector3d image = map(p);
      moved.push_back({image, (*surface.distances)(image)});
      const auto [distance, normal] = (*surface.distances)(inverse(p));
      const Eigen::Vector3d conormal = inverse.matrix.transpose() * normal;
      const double length = conormal.norm();
      fixed.push_back({p, {distance / length, conormal / length}});
    }
  }

  double rms() const {
    double sum = 0;
    for (const auto* points : {&moved, &fixed})
      for (const Mapped_point& p : *points) sum += p.to_other.distance * p.to_other.distance;
    return std::sqrt(sum / double(moved.size() + fixed.size()));
  }
};

inline Centered_map judged(const Centered_surface_3& surface, const Affine_map_3& map, std::size_t points) {
  return {map, Distances_both_ways(surface, map, points).rms()};
}

/// The mean squared distance of the first `count` points of a surface that a map moves.
inline double mean_square_of_moved(const Centered_surface_3& surface, const Affine_map_3& map, std::size_t count) {
  count = std::min(count, surface.samples.points.size());
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i)
    sum += std::pow((*surface.distances)(map(surface.samples.points[i])).distance, 2);
  return sum / double(count);
}

/// How a map about the centroid is refined.
struct Centered_refinement {
  Map_kind kind = Map_kind::RIGID;
  int most_steps = 15;
  std::size_t points = 400;
  Eigen::Vector3d fixed_axis = Eigen::Vector3d::Zero(); ///< the map does not turn any further about it, unless it is 0
};

/// The infinitesimal maps of a kind, without the rotation about an axis.
inline Eigen::MatrixXd infinitesimal_maps(const Centered_refinement& how) {
  const Eigen::MatrixXd maps = infinitesimal_maps(how.kind);
  if (how.fixed_axis.isZero()) return maps;
  Eigen::VectorXd rotation = Eigen::VectorXd::Zero(12);
  for (int i = 0; i < 3; ++i) rotation.segment<3>(3 * i) = Eigen::Vector3d::Unit(i).cross(how.fixed_axis);
  rotation.normalize();
  return maps - rotation * (rotation.transpose() * maps);
}

/// The change of a map by one step of Gauss and Newton. Points further from the other surface than 4 deviations do not
/// count, and directions along which the surface slips stay as they are.
inline Affine_map_3 step_of_refinement(const Distances_both_ways& distances, const Eigen::MatrixXd& maps) {
  constexpr double deviations_per_median = 1.4826, slipping = 1e-8, longest_step = 0.4;
  const double infinity = std::numeric_limits<double>::infinity();
  const double limit = 4 * deviations_per_median * median_distance(distances.moved, distances.fixed, infinity) + 1e-3;
  Eigen::MatrixXd rows(Eigen::Index(distances.moved.size() + distances.fixed.size()), 12);
  Eigen::VectorXd values(rows.rows());
  Eigen::Index count = 0;
  for (const auto* points : {&distances.moved, &distances.fixed})
    for (const auto& [p, to_other] : *points) {
      if (!(std::abs(to_other.distance) <= limit)) continue;
      const double sign = points == &distances.moved ? 1 : -1;
      for (int i = 0; i < 3; ++i) rows.row(count).segment<3>(3 * i) = sign * to_other.normal[i] * p.transpose();
      rows.row(count).tail<3>() = sign * to_other.normal.transpose();
      values[count++] = -to_other.distance;
    }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(slipping);
  decomposition.compute(rows.topRows(count) * maps);
  Eigen::Matrix<double, 12, 1> x = maps * decomposition.solve(values.head(count));
  if (!x.allFinite()) return {};
  if (x.norm() > longest_step) x *= longest_step / x.norm();
  Affine_map_3 change;
  for (int i = 0; i < 3; ++i) change.matrix.row(i) += x.segment<3>(3 * i).transpose();
  change.translation = x.tail<3>();
  return change;
}

inline Affine_map_3 refined(const Centered_surface_3& surface, Affine_map_3 map, const Centered_refinement& how) {
  const Eigen::MatrixXd maps = infinitesimal_maps(how);
  for (int step = 0; step < how.most_steps; ++step) {
    const Distances_both_ways distances(surface, map, how.points);
    const Affine_map_3 change = step_of_refinement(distances, maps);
    Affine_map_3 next = change * map;
    next.matrix = nearest_of_kind(next.matrix, how.kind);
    if (!next.matrix.allFinite() || !(condition(next.matrix) < 10)) return map;
    const double length = (change.matrix - Eigen::Matrix3d::Identity()).norm() + change.translation.norm();
    map = next;
    if (length < std::max(1e-12, 1e-4 * distances.rms())) break;
  }
  return map;
}

} // namespace equiaffine::internal

#endif
