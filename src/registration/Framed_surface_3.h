// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_FRAMED_SURFACE_3_H
#define EQUIAFFINE_SRC_REGISTRATION_FRAMED_SURFACE_3_H

#include "registration/Framed_function_3.h"
#include "registration/Framed_point_3.h"
#include "registration/random_elements.h"
#include <equiaffine/base/internal/Point_tree.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/internal/quantile.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The root of the mean squared distance of points from their mean.
inline double size_of_points(const std::vector<Eigen::Vector3d>& points) {
  if (points.empty()) return 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p / double(points.size());
  double sum = 0;
  for (const auto& p : points) sum += (p - mean).squaredNorm() / double(points.size());
  return std::sqrt(sum);
}

/// A surface that is ready to be matched: points with their frames, and a tree of invariants for each kind of point.
struct Framed_surface_3 {
  const Framed_function_3& function;   ///< frames and matches belong to it
  const Framed_function_3& refinement; ///< maps are refined and judged on it
  std::vector<Framed_point_3> points = {};
  std::vector<Eigen::Vector3d> probes = {}; ///< on the zero set of `refinement`, at random: maps are judged by them
  double size = 0;                          ///< size_of_points
  double spacing = 0;                       ///< 3/2 of the median distance between neighbors
  double noise = 0;  ///< the median distance of the given points from the zero set of `refinement`, beside `size`
  double chance = 0; ///< see chance_of_nearness
  std::array<std::vector<std::size_t>, 2> usable = {}; ///< points with good frames: hyperbolic ones, elliptic ones
  std::array<Point_tree<5>, 2> trees = {};             ///< of their invariants
  Point_tree<3> tree = {};                             ///< of all points

  const Point_tree<5>& tree_of(const Framed_point_3& p) const { return trees[p.is_elliptic]; }
};

/// Points with a frame of less quality are not matched, unless almost all points are such, as those of an ellipsoid that
/// is slightly disturbed. On quadrics the quality has the size of rounding.
constexpr double least_quality = 0.02, least_quality_of_exact_frames = 1e-5;

/// These bounds keep the time of a search independent of the number of points given.
constexpr std::size_t most_framed_points = 6000, most_probes = 600;

/// The invariants by which points are matched: those that maps of the kind keep, and zero for others.
inline Invariants kept_invariants(const Framed_point_3& p, Map_kind kind) {
  Invariants x = p.invariants;
  if (number_of_invariants(kind) < 5) x[4] = 0;
  return x;
}

inline Gradient_of_invariants kept_gradient(const Framed_point_3& p, Map_kind kind) {
  Gradient_of_invariants x = p.gradient;
  if (number_of_invariants(kind) < 5) x.row(4).setZero();
  return x;
}

/// The points that are in the domain, on the surface.
inline std::vector<Eigen::Vector3d> moved_to_surface(bool in_threads, const Framed_function_3& surface,
                                                     std::vector<Eigen::Vector3d> points, int steps = 3) {
  parallel_for(
      in_threads, 0, points.size(), [&](std::size_t i) { points[i] = surface.moved_to_surface(points[i], steps); }, 32);
  std::erase_if(points, [](const Eigen::Vector3d& p) { return !p.allFinite(); });
  return points;
}

/// The median distance of points from a surface, or 0 if it is not defined at any.
inline double median_distance(bool in_threads, const Framed_function_3& surface,
                              const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> distances(points.size());
  parallel_for(
      in_threads, 0, points.size(),
      [&](std::size_t i) { distances[i] = std::abs(surface.distance(points[i]).distance); }, 32);
  std::erase_if(distances, [](double d) { return !std::isfinite(d); });
  return distances.empty() ? 0 : median_of(std::move(distances));
}

/// 3/2 of the median distance of points from the nearest other one.
inline double typical_spacing(const Framed_surface_3& surface) {
  std::vector<double> distances;
  for (const Framed_point_3& p : surface.points) {
    const auto nearest = surface.tree.neighbors(p.point, 2);
    if (nearest.size() == 2) distances.push_back(nearest[1].distance);
  }
  return distances.empty() ? 0 : 1.5 * median_of(std::move(distances));
}

/// A random point of the box around points is nearer to the surface than t `size` with the probability of this times t,
/// for small t. The estimate is half as large again, and at least 1/10.
inline double chance_of_nearness(bool in_threads, const Framed_surface_3& surface) {
  constexpr std::size_t count = 2000;
  constexpr double distance = 0.01;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : surface.probes) box.extend(p);
  std::minstd_rand random(3);
  std::vector<Eigen::Vector3d> points(count);
  for (Eigen::Vector3d& p : points)
    for (int a = 0; a < 3; ++a) p[a] = box.min()[a] + box.sizes()[a] * (double(random()) / double(random.max()));
  std::vector<char> is_inside(count), is_near(count);
  parallel_for(
      in_threads, 0, count,
      [&](std::size_t i) {
        const double d = std::abs(surface.refinement.distance(points[i]).distance);
        is_inside[i] = !std::isnan(d);
        is_near[i] = d < distance * surface.size;
      },
      32);
  const auto inside = std::count(is_inside.begin(), is_inside.end(), 1);
  const auto near = std::count(is_near.begin(), is_near.end(), 1);
  return std::max(0.1, 1.5 * double(near) / std::max(double(inside), 1.0) / distance);
}

/// The least quality of the points that are matched.
inline double least_quality_on(const std::vector<Framed_point_3>& points) {
  const auto good =
      std::count_if(points.begin(), points.end(), [](const auto& p) { return p.quality > least_quality; });
  return std::size_t(good) * 50 > points.size() ? least_quality : least_quality_of_exact_frames;
}

inline void build_trees(Framed_surface_3& surface, Map_kind kind) {
  const double quality = least_quality_on(surface.points);
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < surface.points.size(); ++i) {
    const Framed_point_3& p = surface.points[i];
    all.push_back(i);
    if (p.quality > quality) surface.usable[p.is_elliptic].push_back(i);
  }
  surface.tree = Point_tree<3>(all, [&](std::size_t i) { return surface.points[i].point; });
  for (std::size_t k = 0; k < 2; ++k)
    surface.trees[k] =
        Point_tree<5>(surface.usable[k], [&](std::size_t i) { return kept_invariants(surface.points[i], kind); });
}

/// Moves points along a surface by random steps, unless these leave its domain. Points on the nodes or edges of
/// a lattice may lie on curves: where another surface meets this one in such a curve, many of them would be on it.
inline std::vector<Eigen::Vector3d> spread_over_surface(bool in_threads, const Framed_function_3& surface,
                                                        std::vector<Eigen::Vector3d> points, double longest_step) {
  constexpr int steps = 8;
  std::minstd_rand random(4);
  const auto uniform = [&] { return 2 * double(random()) / double(random.max()) - 1; };
  for (Eigen::Vector3d& p : points) {
    Eigen::Vector3d step;
    for (double& coordinate : step) coordinate = uniform();
    const Eigen::Vector3d normal = surface.distance(p).normal;
    const Eigen::Vector3d moved = p + longest_step * (step - step.dot(normal) * normal);
    if (std::isfinite(surface.first_order(moved).value())) p = moved;
  }
  return moved_to_surface(in_threads, surface, std::move(points), steps);
}

/// Computes the frames of the points, of a random subset if there are very many.
inline Framed_surface_3 framed_surface(bool in_threads, const Framed_function_3& function,
                                       const Framed_function_3& refinement, const std::vector<Eigen::Vector3d>& given,
                                       Map_kind kind, std::size_t most_points = most_framed_points) {
  Framed_surface_3 result{.function = function, .refinement = refinement};
  const auto points = moved_to_surface(in_threads, function, random_elements(given, most_points, 1));
  result.size = size_of_points(points);
  result.points.resize(points.size());
  parallel_for(
      in_threads, 0, points.size(),
      [&](std::size_t i) {
        result.points[i] = function.framed_point(points[i], kind);
        result.points[i].certainty = function.certainty(points[i]);
      },
      16);
  build_trees(result, kind);
  result.spacing = typical_spacing(result);
  result.probes =
      spread_over_surface(in_threads, refinement, random_elements(points, most_probes, 2), result.spacing / 2);
  if (result.probes.empty()) return result;
  result.chance = chance_of_nearness(in_threads, result);
  result.noise = median_distance(in_threads, refinement, random_elements(given, most_probes, 5)) / result.size;
  return result;
}

/// Whether derivatives are those of the surface, and not of a fit, which has errors.
inline bool has_exact_frames(const Framed_surface_3& surface) {
  return std::all_of(surface.points.begin(), surface.points.end(),
                     [](const Framed_point_3& p) { return p.certainty == 1; });
}

} // namespace equiaffine::internal

#endif
