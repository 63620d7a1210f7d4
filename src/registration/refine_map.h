// SPDX-License-Identifier: GPL-3.0-or-later
// Refines a map between surfaces by least squares of the distances of moved points.
#ifndef EQUIAFFINE_SRC_REGISTRATION_REFINE_MAP_H
#define EQUIAFFINE_SRC_REGISTRATION_REFINE_MAP_H

#include "registration/Affine_map_3.h"
#include "registration/Framed_surface_3.h"
#include "registration/candidate_pairs.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/registration/internal/searches.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// A point of one surface in the space of the target, with its distance from the other surface.
struct Mapped_point {
  Eigen::Vector3d point;
  Signed_distance_3 to_other; ///< the distance is NaN outside the domain of the other surface
};

/// Probes of the source moved by a map, with their distances from the target.
inline std::vector<Mapped_point> moved_source(bool in_threads, const Framed_surface_3& source,
                                              const Framed_surface_3& target, const Affine_map_3& map,
                                              std::size_t count) {
  std::vector<Mapped_point> result(std::min(count, source.probes.size()));
  parallel_for(
      in_threads, 0, result.size(),
      [&](std::size_t i) {
        const Eigen::Vector3d p = map(source.probes[i]);
        result[i] = {p, target.refinement.distance(p)};
      },
      32);
  return result;
}

/// Probes of the target with their distances from the moved source.
inline std::vector<Mapped_point> target_beside_moved_source(bool in_threads, const Framed_surface_3& source,
                                                            const Framed_surface_3& target, const Affine_map_3& map,
                                                            std::size_t count) {
  const Affine_map_3 inverse = map.inverse();
  std::vector<Mapped_point> result(std::min(count, target.probes.size()));
  parallel_for(
      in_threads, 0, result.size(),
      [&](std::size_t i) {
        const auto [distance, normal] = source.refinement.distance(inverse(target.probes[i]));
        const Eigen::Vector3d conormal = inverse.matrix.transpose() * normal;
        const double length = conormal.norm();
        result[i] = {target.probes[i], {distance / length, conormal / length}};
      },
      32);
  return result;
}

/// The unit of distances of a map: the smaller of the sizes of the target and the moved source, so that a map does not
/// improve by shrinking the source.
inline double unit_of_distances(const Framed_surface_3& source, const Framed_surface_3& target,
                                const Affine_map_3& map) {
  std::vector<Eigen::Vector3d> moved;
  for (std::size_t i = 0; i < std::min<std::size_t>(100, source.probes.size()); ++i)
    moved.push_back(map(source.probes[i]));
  return std::min(target.size, size_of_points(moved));
}

/// The infinitesimal maps p -> M p + c of a kind, one per column: M row by row, then c.
inline Eigen::MatrixXd infinitesimal_maps(Map_kind kind) {
  Eigen::MatrixXd maps = Eigen::MatrixXd::Zero(12, degrees_of_freedom(kind));
  int n = 0;
  for (int i = 0; i < 3; ++i) maps(9 + i, n++) = 1;
  for (int i = 0; i < 3; ++i)
    for (int j = i + 1; j < 3; ++j) { // rotations; for affine maps also symmetric shears
      maps(3 * i + j, n) = 1;
      maps(3 * j + i, n++) = -1;
      if (keeps_angles(kind)) continue;
      maps(3 * i + j, n) = 1;
      maps(3 * j + i, n++) = 1;
    }
  if (!keeps_angles(kind)) {
    for (int i = 0; i < 2; ++i) {
      maps(4 * i, n) = 1;
      maps(4 * i + 4, n++) = -1;
    }
  }
  if (!keeps_volume(kind)) maps(0, n) = maps(4, n) = maps(8, n) = 1;
  return maps;
}

/// The linear equations for a small change of a map, a combination of infinitesimal maps, that moves points onto the
/// other surface.
class Refinement_equations {
public:
  /// Points are taken relative to `center`, in the unit `size`.
  Refinement_equations(Eigen::MatrixXd basis, const Eigen::Vector3d& center, double size)
      : basis_(std::move(basis)), center_(center), size_(size) {}

  /// Adds the points closer than `tolerance`. `sign` is 1 for points that move with the map, and -1 for fixed points
  /// while the other surface moves.
  void add(const std::vector<Mapped_point>& points, double tolerance, double sign) {
    for (const auto& [point, to_other] : points) {
      const auto& [distance, normal] = to_other;
      if (!(std::abs(distance) < tolerance)) continue;
      const Eigen::Vector3d x = (point - center_) / size_;
      Eigen::Matrix<double, 12, 1> row;
      for (int i = 0; i < 3; ++i) row.segment<3>(3 * i) = normal[i] * x;
      row.tail<3>() = normal;
      rows_.push_back(sign * row);
      values_.push_back(-distance / size_);
    }
  }

  std::size_t size() const { return rows_.size(); }

  /// Returns the coefficients of the least-squares solution of minimum norm, a map to be applied after the current one.
  /// Combinations along which points move less than `threshold` are not changed.
  Eigen::Matrix<double, 12, 1> solution(double threshold) const {
    Eigen::MatrixXd matrix(Eigen::Index(size()), basis_.cols());
    for (std::size_t i = 0; i < size(); ++i) matrix.row(Eigen::Index(i)) = rows_[i].transpose() * basis_;
    const Eigen::Map<const Eigen::VectorXd> values(values_.data(), Eigen::Index(size()));
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(threshold);
    decomposition.compute(matrix);
    const Eigen::VectorXd solution = decomposition.solve(values);
    return basis_ * solution;
  }

  /// Returns the map with these coefficients to first order. Its rotational part is an exact rotation, since on a nearly
  /// spherical surface rotations are poorly determined. It is the rotation closest to the first-order map, which
  /// shortens long, less reliable steps.
  Affine_map_3 map_of(const Eigen::Matrix<double, 12, 1>& x) const {
    const Eigen::Matrix3d change = Eigen::Map<const Eigen::Matrix3d>(x.data()).transpose();
    const Eigen::Vector3d turn =
        Eigen::Vector3d(change(2, 1) - change(1, 2), change(0, 2) - change(2, 0), change(1, 0) - change(0, 1)) / 2;
    Affine_map_3 map;
    map.matrix += (change + change.transpose()) / 2;
    if (!turn.isZero(0)) map.matrix = Eigen::AngleAxisd(std::atan(turn.norm()), turn.normalized()) * map.matrix;
    map.translation = center_ - map.matrix * center_ + size_ * x.tail<3>();
    return map;
  }

private:
  Eigen::MatrixXd basis_;
  Eigen::Vector3d center_;
  double size_;
  std::vector<Eigen::Matrix<double, 12, 1>> rows_;
  std::vector<double> values_;
};

constexpr double deviations_per_median = 1.4826; ///< of a normal distribution

/// The median of the distances below a tolerance.
inline double median_distance(const std::vector<Mapped_point>& a, const std::vector<Mapped_point>& b,
                              double tolerance) {
  std::vector<double> distances;
  for (const auto* points : {&a, &b})
    for (const Mapped_point& p : *points)
      if (std::abs(p.to_other.distance) < tolerance) distances.push_back(std::abs(p.to_other.distance));
  return distances.empty() ? 0 : median_of(distances);
}

/// Options of refinement.
struct Refinement {
  Map_kind kind = Map_kind::AFFINE;
  double tolerance =
      0.05; ///< at first, points farther from the other surface are ignored; relative to its size
  int most_steps = 20;
  std::size_t probes = most_probes;
};

/// Refines a map by Gauss-Newton steps with the points of both surfaces that are within 6 standard deviations of the
/// other one. Returns nothing if too few points are that close, or if the map degenerates: shrinking the source to a
/// point of the target would be a perfect solution.
inline std::optional<Affine_map_3> refine_map(bool in_threads, const Framed_surface_3& source,
                                              const Framed_surface_3& target, const Affine_map_3& start,
                                              const Refinement& how) {
  constexpr double rounding = 1e-12;
  Affine_map_3 map = start;
  const double determinant = start.matrix.determinant();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : source.probes) center += p / double(source.probes.size());
  double tolerance = how.tolerance;
  for (int step = 0; step < how.most_steps; ++step) {
    const double unit = unit_of_distances(source, target, map);
    const auto moved = moved_source(in_threads, source, target, map, how.probes);
    const auto fixed = target_beside_moved_source(in_threads, source, target, map, how.probes);
    const double spread = 6 * deviations_per_median * median_distance(moved, fixed, tolerance * unit) / unit;
    tolerance = std::clamp(spread, 1e-10, tolerance);
    Refinement_equations equations(infinitesimal_maps(how.kind), map(center), unit);
    equations.add(moved, tolerance * unit, 1);
    equations.add(fixed, tolerance * unit, -1);
    if (equations.size() < 16) return std::nullopt;
    const Affine_map_3 change = equations.map_of(equations.solution(rounding));
    Affine_map_3 next = change * map;
    const Eigen::Vector3d image = next(center);
    next.matrix = nearest_of_kind(next.matrix, how.kind);
    next.translation = image - next.matrix * center;
    const bool is_sound = next.matrix.allFinite() && next.translation.allFinite() &&
                          condition(next.matrix) < greatest_condition &&
                          std::abs(std::log(next.matrix.determinant() / determinant)) < 1;
    if (!is_sound) return std::nullopt;
    const double difference = (change.matrix - Eigen::Matrix3d::Identity()).norm();
    map = next;
    if (difference < 1e-13) break;
  }
  return map;
}

/// Returns the first `most` elements, in order, that are not near a previous one.
template <class T, class Is_near>
std::vector<T> without_near(const std::vector<T>& elements, std::size_t most, const Is_near& is_near) {
  std::vector<T> result;
  for (const T& element : elements) {
    if (result.size() == most) break;
    if (std::none_of(result.begin(), result.end(), [&](const T& other) { return is_near(element, other); }))
      result.push_back(element);
  }
  return result;
}

} // namespace equiaffine::internal

#endif
