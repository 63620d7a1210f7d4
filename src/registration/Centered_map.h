// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_CENTERED_MAP_H
#define EQUIAFFINE_SRC_REGISTRATION_CENTERED_MAP_H

#include "registration/Centered_surface_3.h"
#include "registration/Rotation_search.h"
#include "registration/refine_map.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// A map between the coordinates of two Centered_surface_3, or of one, with the rms distance, both ways, between moved
/// points and the surface.
struct Centered_map {
  Affine_map_3 map = {};
  double rms = std::numeric_limits<double>::infinity();
  double greatest = 0; ///< the largest of the distances, where a map was verified
};

inline double difference(const Centered_map& a, const Centered_map& b) {
  return difference(a.map.matrix, b.map.matrix);
}

/// Two surfaces that a map moves onto each other; a surface and itself where symmetries are sought.
struct Centered_pair {
  const Centered_surface_3 &source, &target;

  explicit Centered_pair(const Centered_surface_3& surface) : source(surface), target(surface) {}
  Centered_pair(const Centered_surface_3& from, const Centered_surface_3& to) : source(from), target(to) {}

  /// Whether both have exact centroids, which those of other surfaces than meshes are not.
  bool are_meshes() const { return !source.is_exact && !target.is_exact; }
  /// Whether every map keeps the centroid: along an open tube, say, only the ends tell of a translation.
  bool is_mesh_itself() const { return are_meshes() && &source == &target; }
};

/// The distances of the first `count` points of both surfaces: of moved ones, and of the others beside the moved surface.
struct Distances_both_ways {
  std::vector<Mapped_point> moved, fixed;

  Distances_both_ways(const Centered_pair& surfaces, const Affine_map_3& map, std::size_t count) {
    const auto& [source, target] = surfaces;
    const Affine_map_3 inverse = map.inverse();
    for (std::size_t i = 0; i < std::min(count, source.samples.points.size()); ++i) {
      const Eigen::Vector3d image = map(source.samples.points[i]);
      moved.push_back({image, (*target.distances)(image)});
    }
    for (std::size_t i = 0; i < std::min(count, target.samples.points.size()); ++i) {
      const Eigen::Vector3d& p = target.samples.points[i];
      const auto [distance, normal] = (*source.distances)(inverse(p));
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

inline Centered_map judged(const Centered_pair& surfaces, const Affine_map_3& map, std::size_t points) {
  return {map, Distances_both_ways(surfaces, map, points).rms()};
}

/// The distances of points that a map moves from the surface, in some proportions, the mean over its area there.
struct Distances_of_moved {
  double mean_square, greatest;
};

/// Moves the first samples, and the points that are to be checked, at most `count` of each.
inline Distances_of_moved distances_of_moved(const Centered_surface_3& surface, const Affine_map_3& map,
                                             std::size_t count, const Centered_surface_3::Proportions& in) {
  const auto& samples = surface.samples.points;
  const std::size_t sampled = std::min(count, samples.size()), checked = std::min(count, surface.checked.size());
  const Eigen::Matrix3d of_normals = in.of_normals();
  Distances_of_moved result = {0, 0};
  double total = 0;
  for (std::size_t i = 0; i < sampled; ++i) {
    const double distance = std::abs((*in.distances)(in.map(map(samples[i]))).distance);
    const double weight = (of_normals * surface.samples.normals[i]).norm();
    result.mean_square += weight * distance * distance;
    total += weight;
    result.greatest = std::max(result.greatest, distance);
  }
  result.mean_square /= total;
  for (std::size_t i = 0; i < checked; ++i) {
    const Eigen::Vector3d& p = surface.checked[i * surface.checked.size() / checked];
    result.greatest = std::max(result.greatest, std::abs((*in.distances)(in.map(map(p))).distance));
  }
  return result;
}

/// The same in the proportions in which maps are sought.
inline Distances_of_moved distances_of_moved(const Centered_surface_3& surface, const Affine_map_3& map,
                                             std::size_t count) {
  return distances_of_moved(surface, map, count, {{}, surface.distances});
}

/// The rms distance, both ways, between moved points and the surface, in the proportions of the target, the mean over its
/// area there. It is the one that is `sought` where these are the proportions in which maps are sought.
inline double own_rms(const Centered_pair& surfaces, const Affine_map_3& map, std::size_t count, double sought) {
  const auto& [source, target] = surfaces;
  if (source.own.distances == source.distances && target.own.distances == target.distances) return sought;
  const Affine_map_3 back = map.inverse(), to_source = source.own.map * back * target.own.map.inverse();
  const Eigen::Matrix3d of_moved = (target.own.map.matrix * map.matrix).inverse().transpose();
  const Eigen::Matrix3d of_fixed = target.own.of_normals();
  std::array<double, 2> sums = {0, 0}, weights = {0, 0};
  const auto add = [&](std::size_t side, double weight, double distance) {
    sums[side] += weight * distance * distance;
    weights[side] += weight;
  };
  for (std::size_t i = 0; i < std::min(count, source.samples.points.size()); ++i)
    add(0, (of_moved * source.samples.normals[i]).norm(),
        (*target.own.distances)(target.own.map(map(source.samples.points[i]))).distance);
  for (std::size_t i = 0; i < std::min(count, target.samples.points.size()); ++i) {
    const auto [distance, normal] = (*source.own.distances)(source.own.map(back(target.samples.points[i])));
    add(1, (of_fixed * target.samples.normals[i]).norm(), distance / (to_source.matrix.transpose() * normal).norm());
  }
  return std::sqrt((sums[0] / weights[0] + sums[1] / weights[1]) / 2);
}

/// How a map about the centroid is refined.
struct Centered_refinement {
  Map_kind kind = Map_kind::RIGID;
  int most_steps = 15;
  std::size_t points = 400;
  Eigen::Vector3d fixed_axis = Eigen::Vector3d::Zero(); ///< the map does not turn any further about it, unless it is 0
  bool keeps_center = false;                            ///< the map does not move the origin
};

/// The infinitesimal maps of a kind, without the rotation about an axis.
inline Eigen::MatrixXd infinitesimal_maps(const Centered_refinement& how) {
  Eigen::MatrixXd maps = infinitesimal_maps(how.kind);
  if (how.keeps_center) maps.bottomRows<3>().setZero();
  if (how.fixed_axis.isZero()) return maps;
  Eigen::VectorXd rotation = Eigen::VectorXd::Zero(12);
  for (int i = 0; i < 3; ++i) rotation.segment<3>(3 * i) = Eigen::Vector3d::Unit(i).cross(how.fixed_axis);
  rotation.normalize();
  return maps - rotation * (rotation.transpose() * maps);
}

/// The change of a map by one step of Gauss and Newton. Points further from the other surface than 4 deviations do not
/// count, and directions along which the surface slips stay as they are.
inline Affine_map_3 step_of_refinement(const Distances_both_ways& distances, const Eigen::MatrixXd& maps) {
  constexpr double slipping = 1e-8, longest_step = 0.4;
  const double infinity = std::numeric_limits<double>::infinity();
  const double limit = 4 * deviations_per_median * median_distance(distances.moved, distances.fixed, infinity) + 1e-3;
  Refinement_equations equations(maps, Eigen::Vector3d::Zero(), 1);
  equations.add(distances.moved, limit, 1);
  equations.add(distances.fixed, limit, -1);
  Eigen::Matrix<double, 12, 1> x = equations.solution(slipping);
  if (!x.allFinite()) return {};
  if (x.norm() > longest_step) x *= longest_step / x.norm();
  return equations.map_of(x);
}

/// Refines a map by least squares. Maps of a kind that keeps volumes keep the determinant that they have.
inline Affine_map_3 refined(const Centered_pair& surfaces, Affine_map_3 map, const Centered_refinement& how) {
  const Eigen::MatrixXd maps = infinitesimal_maps(how);
  const double scale = keeps_volume(how.kind) ? std::cbrt(std::abs(map.matrix.determinant())) : 1;
  for (int step = 0; step < how.most_steps; ++step) {
    const Distances_both_ways distances(surfaces, map, how.points);
    const Affine_map_3 change = step_of_refinement(distances, maps);
    Affine_map_3 next = change * map;
    next.matrix = scale * nearest_of_kind(next.matrix, how.kind);
    if (!next.matrix.allFinite() || !(condition(next.matrix) < 10)) return map;
    const double length = (change.matrix - Eigen::Matrix3d::Identity()).norm() + change.translation.norm();
    map = next;
    if (length < std::max(1e-12, 1e-4 * distances.rms())) break;
  }
  return map;
}

} // namespace equiaffine::internal

#endif
