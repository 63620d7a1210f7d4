// SPDX-License-Identifier: GPL-3.0-or-later
// Searches all rotations about the origin by branch and bound, and makes finite groups of maps exact.
#ifndef EQUIAFFINE_SRC_REGISTRATION_ROTATION_SEARCH_H
#define EQUIAFFINE_SRC_REGISTRATION_ROTATION_SEARCH_H

#include "registration/Affine_map_3.h"
#include "registration/Surface_distances.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/base/internal/parallel_for.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The distances from a surface at the nodes of a cube around the origin, interpolated linearly between them: fast,
/// and accurate to about a third of a step, which suffices to search for rotations.
class Distance_grid {
public:
  static Distance_grid of(bool in_threads, const Surface_distances& distances, double radius) {
    Distance_grid grid(radius);
    parallel_for(in_threads, 0, nodes * nodes, [&](std::size_t row) {
      for (std::size_t i = 0; i < nodes; ++i) {
        const Eigen::Vector3d p = Eigen::Vector3d(double(i), double(row % nodes), double(row / nodes)) / grid.scale_;
        grid.values_[row * nodes + i] = float(distances.about(p - Eigen::Vector3d::Constant(radius)));
      }
    });
    return grid;
  }

  double step() const { return 1 / scale_; }

  double operator()(const Eigen::Vector3d& p) const {
    std::size_t cell[3];
    float part[3];
    for (int a = 0; a < 3; ++a) {
      const double x = std::clamp((p[a] + radius_) * scale_, 0.0, double(nodes - 1) - 1e-6);
      cell[a] = std::size_t(x);
      part[a] = float(x - double(cell[a]));
    }
    const float* v = &values_[(cell[2] * nodes + cell[1]) * nodes + cell[0]];
    const auto along_x = [&](const float* w) { return w[0] + part[0] * (w[1] - w[0]); };
    const auto in_plane = [&](const float* w) {
      const float a = along_x(w), b = along_x(w + nodes);
      return a + part[1] * (b - a);
    };
    const float low = in_plane(v), high = in_plane(v + nodes * nodes);
    return double(low + part[2] * (high - low));
  }

private:
  static constexpr std::size_t nodes = 64;

  explicit Distance_grid(double radius)
      : radius_(radius), scale_(double(nodes - 1) / (2 * radius)), values_(nodes * nodes * nodes) {}

  double radius_, scale_;
  std::vector<float> values_;
};

/// The approximate angle between two maps in radians: at most 2 for two rotations, or for two reflections.
inline double difference(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) { return (a - b).norm() / std::sqrt(2.0); }

/// A rotation about the origin, or one times -1, with the rms distance of moved points from the surface.
struct Rotation_candidate {
  Eigen::Matrix3d matrix;
  double rms;
};

/// Rotations close to all that move a surface onto itself.
struct Rotation_candidates {
  std::vector<Rotation_candidate> rotations; ///< sorted by rms, none close to another one
  /// All rotations with a smaller rms are close to one of these. Smaller than requested if there were too many.
  double complete_to = 0;
};

/// Searches all rotations about the origin, and those times -1, by branch and bound. The distance from a surface is
/// 1-Lipschitz, so the rms distance at the center of a cell of rotations exceeds that of any rotation in the cell by
/// at most the radius of the cell times the rms distance of points from an axis.
class Rotation_search {
public:
  /// `spread` is the largest rms distance of the points from an axis.
  Rotation_search(bool in_threads, const Distance_grid& grid, std::vector<Eigen::Vector3d> points, double spread)
      : in_threads_(in_threads), grid_(grid), points_(std::move(points)), spread_(spread) {}

  /// Finds rotations close to all whose rms may be below `tolerance`.
  Rotation_candidates run(double tolerance, bool allows_reflections) const {
    std::vector<Cell> cells = first_cells(allows_reflections);
    double half = 1.0 / first_division;
    while (true) {
      const double bound = tolerance + grid_.step() / 3 + radius(half) * spread_;
      measure(cells, bound);
      std::erase_if(cells, [&](const Cell& cell) { return cell.rms > bound; });
      if (radius(half) < smallest_radius || cells.empty()) break;
      half /= 2;
      cells = divided(cells, half);
    }
    return apart(std::move(cells), tolerance, grid_.step() / 3 + radius(half) * spread_);
  }

private:
  static constexpr int first_division = 5;
  static constexpr double smallest_radius = 0.06, least_difference = 0.1;
  static constexpr std::size_t most_candidates = 3000;

  /// A cube in one of four faces of the hypercube of quaternions up to a factor.
  struct Cell {
    std::array<float, 3> center;
    int face, sign;
    float rms = 0;

    Eigen::Matrix3d matrix() const {
      Eigen::Vector4d q;
      q[face] = 1;
      for (int k = 0; k < 3; ++k) q[k < face ? k : k + 1] = double(center[std::size_t(k)]);
      q.normalize();
      return sign * Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
    }
  };

  /// The largest angle between the center of a cell with sides of 2 `half` and a rotation in it: twice that between
  /// their quaternions, which projection onto the sphere does not increase.
  static double radius(double half) { return 2 * half * std::sqrt(3.0); }

  static std::vector<Cell> first_cells(bool allows_reflections) {
    std::vector<Cell> cells;
    const auto position = [](int i) { return (float(i) + 0.5F) * 2 / first_division - 1; };
    for (const int sign : {1, -1}) {
      if (sign < 0 && !allows_reflections) continue;
      for (int face = 0; face < 4; ++face)
        for (int i = 0; i < first_division; ++i)
          for (int j = 0; j < first_division; ++j)
            for (int k = 0; k < first_division; ++k)
              cells.push_back({{position(i), position(j), position(k)}, face, sign});
    }
    return cells;
  }

  static std::vector<Cell> divided(const std::vector<Cell>& cells, double half) {
    std::vector<Cell> result;
    result.reserve(8 * cells.size());
    for (const Cell& cell : cells) {
      Progress_observer::step();
      for (int part = 0; part < 8; ++part) {
        Cell child = cell;
        for (std::size_t k = 0; k < 3; ++k) child.center[k] += float(part >> k & 1 ? half : -half);
        result.push_back(child);
      }
    }
    return result;
  }

  /// Computes the rms of cells if it is below a bound.
  void measure(std::vector<Cell>& cells, double bound) const {
    const double largest_sum = bound * bound * double(points_.size());
    parallel_for(
        in_threads_, 0, cells.size(),
        [&](std::size_t i) {
          const Eigen::Matrix3d matrix = cells[i].matrix();
          double sum = 0;
          for (const Eigen::Vector3d& p : points_) {
            const double d = grid_(matrix * p);
            sum += d * d;
            if (sum > 1.01 * largest_sum) break;
          }
          cells[i].rms = float(std::sqrt(sum / double(points_.size())));
        },
        256);
  }

  /// Returns the centers of cells, without those close to others with a smaller rms. A rotation in a cell has an rms
  /// smaller than the center by at most `slack`.
  static Rotation_candidates apart(std::vector<Cell> cells, double tolerance, double slack) {
    std::stable_sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.rms < b.rms; });
    Rotation_candidates result{{}, tolerance};
    for (const Cell& cell : cells) {
      Progress_observer::step();
      const Eigen::Matrix3d matrix = cell.matrix();
      if (std::any_of(result.rotations.begin(), result.rotations.end(), [&](const Rotation_candidate& other) {
            return difference(matrix, other.matrix) < least_difference;
          }))
        continue;
      if (result.rotations.size() == most_candidates) {
        result.complete_to = std::clamp(double(cell.rms) - slack, 0.0, tolerance);
        break;
      }
      result.rotations.push_back({matrix, double(cell.rms)});
    }
    return result;
  }

  bool in_threads_;
  const Distance_grid& grid_;
  std::vector<Eigen::Vector3d> points_;
  double spread_;
};

/// Maps that are a finite group up to errors, with a table of their products.
struct Finite_group {
  std::vector<Affine_map_3> maps;
  std::vector<std::vector<std::size_t>> products; ///< products[i][j] is the index of maps[i] * maps[j]
};

/// The index of the map with the nearest matrix, and the difference.
struct Nearest_map {
  std::size_t index = 0;
  double difference = std::numeric_limits<double>::infinity();
};

inline Nearest_map nearest_map(const std::vector<Affine_map_3>& maps, const Eigen::Matrix3d& matrix) {
  Nearest_map best;
  for (std::size_t i = 0; i < maps.size(); ++i)
    if (const double d = difference(maps[i].matrix, matrix); d < best.difference) best = {i, d};
  return best;
}

/// Returns maps as a group, if the product of any two is close to one of them, and multiplication by each map
/// permutes them.
inline std::optional<Finite_group> as_group(const std::vector<Affine_map_3>& maps, double tolerance) {
  Finite_group group{maps, std::vector(maps.size(), std::vector<std::size_t>(maps.size()))};
  for (std::size_t i = 0; i < maps.size(); ++i) {
    std::vector<bool> is_taken(maps.size());
    for (std::size_t j = 0; j < maps.size(); ++j) {
      const auto [index, distance] = nearest_map(maps, maps[i].matrix * maps[j].matrix);
      if (!(distance < tolerance) || is_taken[index]) return std::nullopt;
      is_taken[index] = true;
      group.products[i][j] = index;
    }
  }
  return group;
}

/// Changes the maps of a group slightly, so that their products are exact up to rounding: iterates replacing g by
/// the mean of (g h) h^-1 over all h, and moves the fixed point of all maps to the mean image of the origin. Returns
/// whether it succeeded.
inline bool make_exact(Finite_group& group) {
  constexpr int most_steps = 12;
  auto& maps = group.maps;
  const auto order = double(maps.size());
  for (int step = 0; step < most_steps; ++step) {
    std::vector<Eigen::Matrix3d> inverses;
    for (const Affine_map_3& map : maps) inverses.push_back(map.matrix.inverse());
    std::vector<Eigen::Matrix3d> means(maps.size(), Eigen::Matrix3d::Zero());
    double change = 0;
    for (std::size_t i = 0; i < maps.size(); ++i) {
      for (std::size_t j = 0; j < maps.size(); ++j) means[i] += maps[group.products[i][j]].matrix * inverses[j] / order;
      change = std::max(change, (means[i] - maps[i].matrix).norm());
    }
    for (std::size_t i = 0; i < maps.size(); ++i) maps[i].matrix = means[i];
    if (change < 1e-14) break;
  }
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const Affine_map_3& map : maps) center += map.translation / order;
  for (Affine_map_3& map : maps) map.translation = center - map.matrix * center;
  for (std::size_t i = 0; i < maps.size(); ++i)
    for (std::size_t j = 0; j < maps.size(); ++j)
      if (!(difference(maps[i].matrix * maps[j].matrix, maps[group.products[i][j]].matrix) < 1e-10)) return false;
  return true;
}

} // namespace equiaffine::internal

#endif
