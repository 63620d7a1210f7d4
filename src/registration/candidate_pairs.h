// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of points of two surfaces that may correspond, as starting points of the search for maps.
#ifndef EQUIAFFINE_SRC_REGISTRATION_CANDIDATE_PAIRS_H
#define EQUIAFFINE_SRC_REGISTRATION_CANDIDATE_PAIRS_H

#include "registration/Frame_thresholds.h"
#include "registration/Framed_surface_3.h"
#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/registration/Registration_options.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace equiaffine::internal {

// Chooses the points of a surface to try first: those whose frame is good, and whose invariants change quickly along
// the surface, are rare on it, agree with those of their neighbors, and are certain.

/// The difference of two gradients: 0 if they are equal, at most 1.
inline double mismatch(const Gradient_of_invariants& a, const Gradient_of_invariants& b) {
  return (a - b).norm() / (a.norm() + b.norm() + 1e-300);
}

/// The length of the longer tangent vector of the basis.
inline double tangent_length(const Framed_point_3& p) { return p.basis.leftCols<2>().colwise().norm().maxCoeff(); }

/// The smallest change of the invariants over a spacing of the points.
inline double steepness(const Framed_surface_3& surface, const Framed_point_3& p, Map_kind kind) {
  const Gradient_of_invariants gradient = kept_gradient(p, kind);
  const Eigen::Matrix2d squares = gradient.transpose() * gradient;
  const double trace = squares.trace(), determinant = squares.determinant();
  const double least = 2 * determinant / (trace + std::sqrt(std::max(0.0, trace * trace - 4 * determinant)) + 1e-300);
  return std::sqrt(std::max(0.0, least)) * surface.spacing / tangent_length(p);
}

/// The distance to the eighth nearest of all invariants, relative to the change over two spacings: less than 1 if
/// other parts of the surface have these invariants, too, and 0 if the points have the symmetries of the surface.
inline double rarity(const Framed_surface_3& surface, const Framed_point_3& p, Map_kind kind) {
  const auto nearest = surface.tree_of(p).neighbors(kept_invariants(p, kind), 8);
  const double change = kept_gradient(p, kind).norm() * 2 * surface.spacing / tangent_length(p);
  return std::min(1.0, nearest.back().distance / (change + 1e-12));
}

/// The mean mismatch of gradients between a point and its neighbors on the surface.
inline double disagreement(const Framed_surface_3& surface, const Framed_point_3& p, Map_kind kind) {
  constexpr std::size_t neighbors = 6;
  double sum = 0;
  for (const auto& [index, distance] : surface.tree.neighbors(p.point, neighbors + 1)) {
    const Framed_point_3& q = surface.points[index];
    const bool is_alike = q.has_frame() && q.is_elliptic == p.is_elliptic;
    sum += is_alike ? mismatch(kept_gradient(p, kind), kept_gradient(q, kind)) : 1;
  }
  return sum / neighbors; // the mismatch of the point itself is 0
}

/// The weights of all points, 0 for those that should not be matched.
inline std::vector<double> weights_of_points(bool in_threads, const Framed_surface_3& surface, Map_kind kind,
                                             const Frame_thresholds& thresholds) {
  std::vector<double> weights(surface.points.size(), 0), slopes(surface.points.size(), 0);
  for (const auto& usable : surface.usable) {
    if (usable.size() < 8) continue;
    parallel_for(
        in_threads, 0, usable.size(),
        [&](std::size_t n) {
          const Framed_point_3& p = surface.points[usable[n]];
          slopes[usable[n]] = steepness(surface, p, kind);
          weights[usable[n]] = p.certainty * std::min(p.quality, thresholds.greatest_quality) *
                               (thresholds.least_rarity + rarity(surface, p, kind)) *
                               std::exp(-thresholds.loss_by_disagreement * disagreement(surface, p, kind)) /
                               (1 + thresholds.loss_by_condition * condition(p.basis));
        },
        16);
    std::vector<double> of_kind;
    for (const std::size_t i : usable) of_kind.push_back(slopes[i]);
    const double typical = median_of(of_kind);
    for (const std::size_t i : usable) weights[i] *= typical > 0 ? std::min(1.0, slopes[i] / typical) : 0;
  }
  return weights;
}

/// Returns the best of each of up to `count` random groups of points, the best first, so that they are spread over
/// the surface.
inline std::vector<std::size_t> points_to_try(bool in_threads, const Framed_surface_3& surface, Map_kind kind,
                                              std::size_t count, const Frame_thresholds& thresholds = {}) {
  const std::vector<double> weights = weights_of_points(in_threads, surface, kind, thresholds);
  std::vector<std::size_t> candidates;
  for (const std::size_t i : random_subset(weights.size(), weights.size(), 4))
    if (weights[i] > 0) candidates.push_back(i);
  count = std::min(count, candidates.size());
  std::vector<std::size_t> best;
  for (std::size_t g = 0; g < count; ++g)
    best.push_back(*std::max_element(candidates.begin() + std::ptrdiff_t(g * candidates.size() / count),
                                     candidates.begin() + std::ptrdiff_t((g + 1) * candidates.size() / count),
                                     [&](std::size_t a, std::size_t b) { return weights[a] < weights[b]; }));
  std::stable_sort(best.begin(), best.end(), [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
  return best;
}

/// A point of the source, and one of the target near which its counterpart may be.
struct Candidate_pair {
  std::size_t source, target;
  double cost;
};

/// The step along the tangent vectors of a point after which its invariants are closest to the desired ones.
inline Eigen::Vector2d step_to(const Gradient_of_invariants& gradient, const Invariants& difference, double damping) {
  Eigen::Matrix2d normal = gradient.transpose() * gradient;
  normal.diagonal().array() += damping * normal.trace() + std::numeric_limits<double>::min();
  return normal.inverse() * (gradient.transpose() * difference);
}

/// The cost of a pair, or infinity if the counterpart would be too far from the point of the target, or gradients
/// differ too much.
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

/// Returns the candidates for the points of the source, lowest cost first.
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

/// A point of the source, and the nearby point of the target with the most similar invariants.
struct Counterpart {
  std::size_t source = 0;
  Framed_point_3 target;
  double residual = 0; ///< of the invariants
  double cost = 0;     ///< 0 for a perfect pair, and 1 or 2 for a coincidence
};

/// Finds the counterpart by up to 6 Gauss-Newton steps along the target from the candidate, with 5 expansions each.
/// Returns the best point on the way, because wrong structure may misdirect steps. The search stops where the target
/// has no frame, or too far from the candidate.
inline Counterpart find_counterpart(const Framed_surface_3& source, const Framed_surface_3& target,
                                    const Candidate_pair& pair, Map_kind kind,
                                    const Frame_thresholds& thresholds = {}) {
  constexpr int most_steps = 6;
  const Framed_point_3& p = source.points[pair.source];
  const Eigen::Vector3d begin = target.points[pair.target].point;
  Counterpart best, next{pair.source, target.points[pair.target]};
  for (int step = 0;; ++step) {
    const Framed_point_3& q = next.target;
    const Gradient_of_invariants gradient = kept_gradient(q, kind);
    const Invariants difference = kept_invariants(p, kind) - kept_invariants(q, kind);
    next.residual = difference.norm();
    next.cost = next.residual / thresholds.accidental_residual +
                mismatch(kept_gradient(p, kind), gradient) / thresholds.accidental_mismatch;
    if (step == 0 || next.cost < best.cost) best = next;
    if (step == most_steps || next.residual < 1e-13) return best;
    Eigen::Vector3d move = q.basis.leftCols<2>() * step_to(gradient, difference, 1e-9);
    if (move.norm() < 1e-14 * target.size) return best;
    move *= std::min(1.0, 1.5 * target.spacing / move.norm());
    next.target = target.function.framed_point(target.function.moved_to_surface(q.point + move, 3), kind);
    const bool is_near = (next.target.point - begin).norm() < thresholds.longest_way * target.spacing;
    if (!next.target.has_frame() || next.target.is_elliptic != p.is_elliptic || !is_near) return best;
  }
}

} // namespace equiaffine::internal

#endif
