// SPDX-License-Identifier: GPL-3.0-or-later
#include "registration_peers.h"

#include <equiaffine/base/internal/Point_tree.h>

#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace {

using Affine = Eigen::Affine3d;

constexpr int steps = 200; ///< of iterative closest points

template <int Dimension>
using Tree = equiaffine::Point_tree<Dimension>;

template <int Dimension, class Points>
Tree<Dimension> tree_of(const Points& points) {
  std::vector<std::size_t> positions(points.size());
  std::iota(positions.begin(), positions.end(), std::size_t(0));
  return Tree<Dimension>(positions, [&](std::size_t i) { return points[i]; });
}

/// The mean of points and the square root of their covariance.
struct Moments {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d root;
  double size;

  explicit Moments(const Vectors& points) {
    for (const auto& p : points) mean += p / double(points.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const auto& p : points) covariance += (p - mean) * (p - mean).transpose() / double(points.size());
    root = covariance.llt().matrixL();
    size = std::sqrt(covariance.trace());
  }
};

/// The least-squares affine map between corresponding points.
Affine affine_map(const Vectors& from, const Vectors& to) {
  Eigen::MatrixXd rows(Eigen::Index(from.size()), 4), images(Eigen::Index(from.size()), 3);
  for (std::size_t i = 0; i < from.size(); ++i) {
    rows.row(Eigen::Index(i)) << from[i].transpose(), 1;
    images.row(Eigen::Index(i)) = to[i].transpose();
  }
  const Eigen::Matrix<double, 4, 3> solution = rows.colPivHouseholderQr().solve(images);
  Affine map;
  map.matrix().setIdentity();
  map.matrix().topRows<3>() = solution.transpose();
  return map;
}

/// Registers up to 500 of the points with their nearest points in a tree.
class Closest_points {
public:
  Closest_points(const Vectors& source, const Vectors& target)
      : source_(source.begin(), source.begin() + std::ptrdiff_t(std::min<std::size_t>(500, source.size()))),
        target_(target), tree_(tree_of<3>(target)) {}

  Affine refined(Affine map, int count) const {
    for (int step = 0; step < count; ++step) {
      Vectors nearest;
      for (const auto& p : source_) nearest.push_back(target_[tree_.neighbors(map * p, 1).front().index]);
      map = affine_map(source_, nearest);
    }
    return map;
  }

  double median_distance(const Affine& map) const {
    std::vector<double> distances;
    for (const auto& p : source_) distances.push_back(tree_.neighbors(map * p, 1).front().distance);
    const auto middle = distances.begin() + std::ptrdiff_t(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
  }

private:
  Vectors source_;
  const Vectors& target_;
  Tree<3> tree_;
};

Eigen::Matrix3d random_orthogonal_matrix(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::Matrix3d matrix;
  for (double& x : matrix.reshaped()) x = normal(random);
  const Eigen::Matrix3d orthogonal = Eigen::HouseholderQR<Eigen::Matrix3d>(matrix).householderQ();
  return random() & 1 ? orthogonal : Eigen::Matrix3d(-orthogonal);
}

Affine map_about(const Moments& from, const Eigen::Matrix3d& matrix, const Moments& to) {
  return Eigen::Translation3d(to.mean) * Affine(matrix) * Eigen::Translation3d(-from.mean);
}

/// Distances are relative to the size of the moved source, so that a map that shrinks the source is not better.
double badness(const Closest_points& points, const Affine& map, const Moments& source) {
  return points.median_distance(map) / (map.linear() * source.root).norm();
}

} // namespace

Affine affine_icp(const Vectors& source, const Vectors& target, int starts) {
  const Moments from(source), to(target);
  const Closest_points points(source, target);
  std::mt19937_64 random(1);
  Affine best;
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < starts; ++n) {
    const Eigen::Matrix3d turn = n == 0 ? Eigen::Matrix3d::Identity() : random_orthogonal_matrix(random);
    const Affine map = points.refined(map_about(from, to.size / from.size * turn, to), steps);
    if (const double bad = badness(points, map, from); n == 0 || bad < least) {
      least = bad;
      best = map;
    }
  }
  return best;
}

Affine whitening_with_rotations(const Vectors& source, const Vectors& target, int rotations) {
  constexpr std::size_t refined_rotations = 20;
  const Moments from(source), to(target);
  const Vectors some(source.begin(), source.begin() + std::ptrdiff_t(std::min<std::size_t>(150, source.size())));
  const Closest_points few(some, target), points(source, target);
  std::mt19937_64 random(1);
  std::vector<std::pair<double, Affine>> maps;
  for (int n = 0; n < rotations; ++n) {
    const Affine map = map_about(from, to.root * random_orthogonal_matrix(random) * from.root.inverse(), to);
    maps.emplace_back(few.median_distance(map), map);
  }
  std::sort(maps.begin(), maps.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  maps.resize(std::min(maps.size(), refined_rotations));
  for (auto& [bad, map] : maps) {
    map = points.refined(map, steps);
    bad = badness(points, map, from);
  }
  return std::min_element(maps.begin(), maps.end(), [](const auto& a, const auto& b) { return a.first < b.first; })
      ->second;
}

Affine four_point_ransac(const Vectors& source, const Signatures& signatures, const Vectors& target,
                         const Signatures& target_signatures, int samples) {
  const auto tree = tree_of<5>(target_signatures);
  Vectors images;
  for (const auto& s : signatures) images.push_back(target[tree.neighbors(s, 1).front().index]);
  const double tolerance = 0.01 * Moments(target).size;
  std::mt19937_64 random(1);
  Affine best = Affine::Identity();
  std::size_t most = 0;
  for (int n = 0; n < samples; ++n) {
    Vectors from, to;
    for (int k = 0; k < 4; ++k) {
      const std::size_t i = random() % source.size();
      from.push_back(source[i]);
      to.push_back(images[i]);
    }
    const Affine map = affine_map(from, to);
    std::size_t hits = 0;
    for (std::size_t i = 0; i < source.size(); i += 1 + source.size() / 300)
      hits += (map * source[i] - images[i]).norm() < tolerance;
    if (hits <= most || !(std::abs(map.linear().determinant()) > 1e-9)) continue;
    most = hits;
    best = map;
  }
  return Closest_points(source, target).refined(best, steps);
}
