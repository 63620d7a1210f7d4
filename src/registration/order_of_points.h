// SPDX-License-Identifier: GPL-3.0-or-later
// Chooses the points of a surface that are tried first: those whose frame is good, whose invariants change quickly along
// the surface and are rare on it, agree with those of their neighbors, and are not in doubt.
#ifndef EQUIAFFINE_SRC_REGISTRATION_ORDER_OF_POINTS_H
#define EQUIAFFINE_SRC_REGISTRATION_ORDER_OF_POINTS_H

#include "registration/Framed_surface_3.h"
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/base/internal/random_subset.h>
#include <equiaffine/registration/internal/Frame_thresholds.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// How much two gradients differ: 0 if they are equal, 1 at most.
inline double mismatch(const Gradient_of_invariants& a, const Gradient_of_invariants& b) {
  return (a - b).norm() / (a.norm() + b.norm() + 1e-300);
}

/// The length of the longer one of the tangent vectors of the basis.
inline double tangent_length(const Framed_point_3& p) { return p.basis.leftCols<2>().colwise().norm().maxCoeff(); }

/// By how much the invariants change at least over a spacing of the points.
inline double steepness(const Framed_surface_3& surface, const Framed_point_3& p, Map_kind kind) {
  const Gradient_of_invariants gradient = kept_gradient(p, kind);
  const Eigen::Matrix2d squares = gradient.transpose() * gradient;
  const double trace = squares.trace(), determinant = squares.determinant();
  const double least = 2 * determinant / (trace + std::sqrt(std::max(0.0, trace * trace - 4 * determinant)) + 1e-300);
  return std::sqrt(std::max(0.0, least)) * surface.spacing / tangent_length(p);
}

/// The distance to the eighth nearest of all invariants, beside the change over two spacings: less than 1 if other
/// parts of the surface have these invariants, too, and 0 if the points are as symmetric as the surface.
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
  return sum / neighbors; // the point itself adds nothing
}

/// The weights of all points, 0 for one that is not to be matched.
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

/// Returns the best of each of up to `count` random groups of points, the best first, so that they are spread over the
/// surface.
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

} // namespace equiaffine::internal

#endif
