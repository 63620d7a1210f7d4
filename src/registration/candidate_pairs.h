// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_CANDIDATE_PAIRS_H
#define EQUIAFFINE_SRC_REGISTRATION_CANDIDATE_PAIRS_H

#include "registration/Framed_surface_3.h"
#include "registration/order_of_points.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/registration/internal/Frame_thresholds.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// A point of the source and one of the target near which its counterpart may be.
struct Candidate_pair {
  std::size_t source, target;
  double cost;
};

/// The step along the tangent vectors of a point after which its invariants differ least from the wanted ones.
inline Eigen::Vector2d step_to(const Gradient_of_invariants& gradient, const Invariants& difference, double damping) {
  Eigen::Matrix2d normal = gradient.transpose() * gradient;
  normal.diagonal().array() += damping * normal.trace() + std::numeric_limits<double>::min();
  return normal.inverse() * (gradient.transpose() * difference);
}

/// The cost of a pair, or infinity if the counterpart would be too far from the point of the target, or
/// gradients differ too much.
inline double cost_of_pair(const Framed_surface_3& target, const Framed_point_3& p, const Framed_point_3& q,
                           Map_kind kind, double greatest_mismatch, const Frame_thresholds& thresholds) {
  const Gradient_of_invariants gradient = kept_gradient(q, kind);
  const Invariants difference = kept_invariants(p, kind) - kept_invariants(q, kind);
  const Eigen::Vector2d step = step_to(gradient, difference, 1e-6);
  const double length = (q.basis.leftCols<2>() * step).norm() / target.spacing;
  const double mismatched = mismatch(kept_gradient(p, kind), gradient);
  if (!(length < thresholds.longest_step && mismatched < greatest_mismatch))
    return std::numeric_limits<double>::infinity();
  const double change = gradient.norm() * target.spacing / q.basis.leftCols<2>().norm();
  return mismatched + thresholds.cost_of_rest * (difference - gradient * step).norm() / (change + 1e-6) +
         thresholds.cost_of_step * length;
}

inline std::vector<Candidate_pair> pairs_of_point(const Framed_surface_3& source, const Framed_surface_3& target,
                                                  std::size_t i, Map_kind kind, const Candidate_limits& limits,
                                                  const Frame_thresholds& thresholds = {}) {
  const Framed_point_3& p = source.points[i];
  std::vector<Candidate_pair> pairs;
  for (const auto& [j, distance] : target.tree_of(p).neighbors(kept_invariants(p, kind), limits.neighbors)) {
    const double cost = cost_of_pair(target, p, target.points[j], kind, limits.greatest_mismatch, thresholds);
    if (std::isfinite(cost)) pairs.push_back({i, j, cost});
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  if (pairs.size() > limits.best) pairs.resize(limits.best);
  return pairs;
}

/// Returns the candidates for the points of the source, those of the least cost first.
inline std::vector<Candidate_pair> candidate_pairs(bool in_threads, const Framed_surface_3& source,
                                                   const Framed_surface_3& target, std::span<const std::size_t> points,
                                                   Map_kind kind, const Candidate_limits& limits,
                                                   const Frame_thresholds& thresholds) {
  std::vector<std::vector<Candidate_pair>> of_points(points.size());
  parallel_for(in_threads, 0, points.size(), [&](std::size_t n) {
    of_points[n] = pairs_of_point(source, target, points[n], kind, limits, thresholds);
  });
  std::vector<Candidate_pair> pairs;
  for (const auto& some : of_points) pairs.insert(pairs.end(), some.begin(), some.end());
  std::stable_sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  return pairs;
}

} // namespace equiaffine::internal

#endif
