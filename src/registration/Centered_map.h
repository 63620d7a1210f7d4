// SPDX-License-Identifier: GPL-3.0-or-later
// Maps between whole surfaces with a common centroid: judging and refining them, and rotations among them.
#ifndef EQUIAFFINE_SRC_REGISTRATION_CENTERED_MAP_H
#define EQUIAFFINE_SRC_REGISTRATION_CENTERED_MAP_H

#include "registration/Centered_surface_3.h"
#include "registration/Rotation_search.h"
#include "registration/refine_map.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/registration/slippage_of_mesh.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A map between the coordinates of two Centered_surface_3, or of one, with the rms distance in both directions
/// between moved points and the surface.
struct Centered_map {
  Affine_map_3 map = {};
  double rms = std::numeric_limits<double>::infinity();
  double greatest = 0; ///< largest of the distances, if the map was verified
};

inline double difference(const Centered_map& a, const Centered_map& b) {
  return difference(a.map.matrix, b.map.matrix);
}

/// Two surfaces that a map moves onto each other, or one surface and itself in a search for symmetries.
struct Centered_pair {
  const Centered_surface_3 &source, &target;

  explicit Centered_pair(const Centered_surface_3& surface) : source(surface), target(surface) {}
  Centered_pair(const Centered_surface_3& from, const Centered_surface_3& to) : source(from), target(to) {}

  /// Whether both have exact centroids, as only meshes do.
  bool are_meshes() const { return !source.is_exact && !target.is_exact; }
  /// Whether every map preserves the centroid. Along an open tube, for example, a translation is detected only at
  /// the ends.
  bool is_mesh_itself() const { return are_meshes() && &source == &target; }
};

/// The distances of the first `count` points of both surfaces: of moved points from the target, and of points of the
/// target from the moved source.
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

/// The distances of moved points from the surface in given proportions; the mean is over the area there.
struct Distances_of_moved {
  double mean_square, greatest;
};

/// Moves the first samples, and the points to check, at most `count` of each.
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

/// The same in the proportions of the search.
inline Distances_of_moved distances_of_moved(const Centered_surface_3& surface, const Affine_map_3& map,
                                             std::size_t count) {
  return distances_of_moved(surface, map, count, {{}, surface.distances});
}

/// The rms distance in both directions between moved points and the surface, in the proportions of the target; the
/// mean is over the area there. Returns `sought` if these are the proportions of the search.
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

/// How to refine a map about the centroid.
struct Centered_refinement {
  Map_kind kind = Map_kind::RIGID;
  int most_steps = 15;
  std::size_t points = 400;
  Eigen::Vector3d fixed_axis = Eigen::Vector3d::Zero(); ///< unless it is 0, the map does not turn further about this
                                                        ///< axis
  bool keeps_center = false;                            ///< whether the map fixes the origin
};

/// The infinitesimal maps of a kind, without the rotation about the fixed axis.
inline Eigen::MatrixXd infinitesimal_maps(const Centered_refinement& how) {
  Eigen::MatrixXd maps = infinitesimal_maps(how.kind);
  if (how.keeps_center) maps.bottomRows<3>().setZero();
  if (how.fixed_axis.isZero()) return maps;
  Eigen::VectorXd rotation = Eigen::VectorXd::Zero(12);
  for (int i = 0; i < 3; ++i) rotation.segment<3>(3 * i) = Eigen::Vector3d::Unit(i).cross(how.fixed_axis);
  rotation.normalize();
  return maps - rotation * (rotation.transpose() * maps);
}

/// The change of a map in one Gauss-Newton step. Points farther than 4 deviations from the other surface are
/// ignored, and directions along which the surface slides do not change.
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

/// Refines a map by least squares. Maps of a kind that preserves volumes keep their determinant.
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

/// Returns rotations about the centroid close to all rotations that may move one surface to within an rms distance
/// of the other, or of itself.
inline Rotation_candidates candidate_rotations(bool in_threads, const Centered_surface_3& source,
                                               const Centered_surface_3& target, double tolerance,
                                               bool allows_reflections) {
  constexpr int most_points = 80;
  const double radius = 1.02 * std::max(source.samples.radius(), target.samples.radius());
  const auto grid = Distance_grid::of(in_threads, *target.distances, radius);
  const auto& points = source.samples.points;
  const Eigen::Vector3d extents = source.extents();
  const Rotation_search search(in_threads, grid, {points.begin(), points.begin() + most_points},
                               extents.tail<2>().norm());
  const double error = target.is_exact ? target.samples.spacing() / 2 : 0; // of the nearest sample
  Rotation_candidates candidates = search.run(tolerance + error, allows_reflections);
  candidates.complete_to -= error;
  return candidates;
}

/// Maps with a smaller difference are the same.
constexpr double same_map = 0.03;

constexpr std::size_t points_of_rms = 1500;

/// Returns the maps below an rms, sorted by rms, without those that are the same as better ones.
inline std::vector<Centered_map> different(std::vector<Centered_map> maps, double greatest_rms) {
  std::stable_sort(maps.begin(), maps.end(),
                   [](const Centered_map& a, const Centered_map& b) { return a.rms < b.rms; });
  std::erase_if(maps, [&](const Centered_map& map) { return !(map.rms < greatest_rms); });
  return without_near(maps, maps.size(),
                      [](const Centered_map& a, const Centered_map& b) { return difference(a, b) < same_map; });
}

/// Refines a map by least squares, and judges it with many points. A map between meshes preserves the centroid if it
/// is as good then.
inline Centered_map refined_and_judged(const Centered_pair& surfaces, const Affine_map_3& map, Map_kind kind) {
  const auto refined_map = [&](const Affine_map_3& m, bool keeps_center) {
    const Centered_refinement how = {.kind = kind, .most_steps = 10, .points = 300, .keeps_center = keeps_center};
    return judged(surfaces, refined(surfaces, m, how), points_of_rms);
  };
  const Centered_map first = refined_map(map, surfaces.is_mesh_itself());
  if (surfaces.is_mesh_itself() || !surfaces.are_meshes()) return first;
  const Centered_map fixed = refined_map({first.map.matrix}, true);
  const double rounding = exact_distance(std::max(surfaces.source.rounding, surfaces.target.rounding));
  return fixed.rms <= first.rms + rounding ? fixed : first;
}

/// Refined maps.
struct Refined_maps {
  std::vector<Centered_map> maps; ///< distinct maps, sorted by rms
  /// The smallest rms of a map that was dropped because there were too many; close to its rms after refinement.
  double least_left_out = std::numeric_limits<double>::infinity();

  void keep(std::size_t most) {
    if (maps.size() <= most) return;
    least_left_out = std::min(least_left_out, maps[most].rms);
    maps.resize(most);
  }
};

/// Refines rotations times a `scale`, and returns the resulting maps below an rms. A few steps with a few points
/// determine which ones to refine further: the best few hundred, unless all are requested.
inline Refined_maps refined_candidates(bool in_threads, const Centered_pair& surfaces,
                                       const std::vector<Rotation_candidate>& rotations, double scale, Map_kind kind,
                                       double greatest_rms, bool are_all_asked_for = false) {
  constexpr std::size_t most_after_first = 600, most_after_second = 250;
  Refined_maps result;
  auto& maps = result.maps;
  for (const Rotation_candidate& rotation : rotations) maps.push_back({{scale * rotation.matrix}});
  const auto refine = [&](int steps, std::size_t points, double gate) {
    const Centered_refinement how = {
        .kind = Map_kind::RIGID, .most_steps = steps, .points = points, .keeps_center = surfaces.is_mesh_itself()};
    parallel_for(in_threads, 0, maps.size(),
                 [&](std::size_t i) { maps[i] = judged(surfaces, refined(surfaces, maps[i].map, how), points); });
    maps = different(std::move(maps), gate);
  };
  refine(3, 40, 2 * greatest_rms);
  if (!are_all_asked_for) result.keep(most_after_first);
  refine(6, 100, greatest_rms);
  if (!are_all_asked_for) result.keep(most_after_second);
  parallel_for(in_threads, 0, maps.size(),
               [&](std::size_t i) { maps[i] = refined_and_judged(surfaces, maps[i].map, kind); });
  maps = different(std::move(maps), greatest_rms);
  return result;
}

/// An axis about which a surface turns with little change. It is judged by rotations of finite angles, because by
/// small ones even a fine gear turns.
struct Slipping_rotation {
  Infinitesimal_map_3 generator; ///< in the coordinates of the Centered_surface_3
  double rms;                    ///< largest of the rotations
  double own_rms;                ///< the same in the proportions of the surface
};

/// The axis of an approximate rotation, from its antisymmetric part.
inline Eigen::Vector3d axis_of(const Eigen::Matrix3d& m) {
  return Eigen::Vector3d(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)).normalized();
}

/// Returns the three axes about which rotations move points least off the surface, sorted by rms. Rotations of a
/// mesh preserve its exact centroid, and their axis is refined only once: refining each rotation would fit it to the
/// facets.
inline std::vector<Slipping_rotation> slipping_rotations(bool in_threads, const Centered_surface_3& surface,
                                                         Map_kind kind) {
  constexpr std::array<double, 4> angles = {1.0, 0.381966, 1.618034, 2.618034};
  constexpr std::size_t points = 3000;
  constexpr double greatest_change = 0.1;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  const auto& samples = surface.samples;
  for (std::size_t i = 0; i < std::min(points, samples.points.size()); ++i) {
    const Eigen::Vector3d moment = samples.points[i].cross(samples.normals[i]);
    squares += moment * moment.transpose();
  }
  const Centered_pair itself(surface);
  const bool is_mesh = itself.is_mesh_itself();
  Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(squares).eigenvectors();
  // A rotation about an axis after refinement, or unchanged if refinement pulls it to a nearby symmetry.
  const auto refined_rotation = [&](double angle, const Eigen::Vector3d& axis) -> Affine_map_3 {
    const Affine_map_3 rotation = {Eigen::AngleAxisd(angle, axis).toRotationMatrix()};
    const Affine_map_3 map = refined(itself, rotation, {kind, 8, 400, axis, is_mesh});
    return difference(map.matrix, rotation.matrix) < greatest_change ? map : rotation;
  };
  if (is_mesh)
    parallel_for(in_threads, 0, 3, [&](std::size_t i) {
      const Eigen::Vector3d axis = axes.col(Eigen::Index(i));
      axes.col(Eigen::Index(i)) = axis_of(refined_rotation(angles[0], axis).matrix);
    });
  std::array<Centered_map, 3 * angles.size()> maps;
  std::array<double, maps.size()> own;
  parallel_for(in_threads, 0, maps.size(), [&](std::size_t i) {
    const Eigen::Vector3d axis = axes.col(Eigen::Index(i / angles.size()));
    const double angle = angles[i % angles.size()];
    const Affine_map_3 rotation = {Eigen::AngleAxisd(angle, axis).toRotationMatrix()};
    maps[i] = judged(itself, is_mesh ? rotation : refined_rotation(angle, axis), points);
    own[i] = own_rms(itself, maps[i].map, points, maps[i].rms);
  });
  std::vector<Slipping_rotation> result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Slipping_rotation slipping = {};
    for (std::size_t k = axis * angles.size(); k < (axis + 1) * angles.size(); ++k) {
      slipping.rms = std::max(slipping.rms, maps[k].rms);
      slipping.own_rms = std::max(slipping.own_rms, own[k]);
    }
    const Affine_map_3 turn = maps[axis * angles.size()].map, back = turn.inverse();
    const double sine = std::sin(angles[0]);
    slipping.generator.matrix = (turn.matrix - back.matrix) / (2 * sine);
    // The rotation and its generator have the same fixed points.
    slipping.generator.translation = (turn.translation - back.translation) / (2 * sine);
    result.push_back(slipping);
  }
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.rms < b.rms; });
  return result;
}

/// Whether rotations of a mesh move no point farther off it than facets are off the smooth surface, or than
/// `rounding`. A part that is not one of revolution moves farther, which the rms may not show.
inline bool keeps_to_facets(bool in_threads, const Centered_surface_3& surface, const Slipping_rotation& rotation,
                            double rounding) {
  constexpr std::array<double, 3> angles = {0.381966, 1.618034, 2.618034};
  constexpr std::size_t points = 20000;
  constexpr double factor = 3; // 8 / 3 for regular triangles on a sphere
  const Eigen::Vector3d axis = axis_of(rotation.generator.matrix);
  std::array<double, angles.size()> greatest;
  parallel_for(in_threads, 0, angles.size(), [&](std::size_t i) {
    const Affine_map_3 map = {Eigen::AngleAxisd(angles[i], axis).toRotationMatrix()};
    greatest[i] = distances_of_moved(surface, map, points).greatest;
  });
  return *std::max_element(greatest.begin(), greatest.end()) < rounding + factor * surface.samples.greatest_facet_error;
}

/// The generators, in the coordinates of the surface, of the rotations whose rms is below a limit. Rotations about
/// two axes generate those about a third one, so if two are below the limit, only one is valid.
inline Affine_slippage_3 continuous_symmetries(const Centered_surface_3& surface,
                                               const std::vector<Slipping_rotation>& rotations, double greatest_rms) {
  auto count = std::count_if(rotations.begin(), rotations.end(),
                             [&](const Slipping_rotation& r) { return r.rms < greatest_rms; });
  if (count == 2) count = 1;
  if (count == 0) return {};
  const Affine_map_3& to = surface.map;
  const Eigen::Matrix3d from = to.matrix.inverse();
  Affine_slippage_3 result;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Infinitesimal_map_3& generator = rotations[std::size_t(i)].generator;
    result.rms = std::max(result.rms, rotations[std::size_t(i)].own_rms);
    result.generators.push_back(
        {from * generator.matrix * to.matrix, from * (generator.matrix * to.translation + generator.translation)});
  }
  return result;
}

} // namespace equiaffine::internal

#endif
