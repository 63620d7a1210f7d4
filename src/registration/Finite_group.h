// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_FINITE_GROUP_H
#define EQUIAFFINE_SRC_REGISTRATION_FINITE_GROUP_H

#include "registration/Affine_map_3.h"
#include "registration/Rotation_search.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// Maps that are a finite group up to errors, with the numbers of their products.
struct Finite_group {
  std::vector<Affine_map_3> maps;
  std::vector<std::vector<std::size_t>> products; ///< products[i][j] is the number of maps[i] * maps[j]
};

/// The number of the map whose matrix is nearest, and how far it is.
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

/// Returns maps as a group, if the product of any two is near to one of them, and multiplication by each map permutes
/// them.
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

/// Changes the maps of a group slightly, so that their products are right up to rounding: g becomes the mean of
/// (g h) h^-1 over all h, some times, and all maps have the fixed point that is the mean image of the origin. Returns
/// whether they are right.
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
