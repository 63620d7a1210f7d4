// SPDX-License-Identifier: GPL-3.0-or-later
// Thresholds and limits of the search for maps by affine frames.
#ifndef EQUIAFFINE_SRC_REGISTRATION_FRAME_THRESHOLDS_H
#define EQUIAFFINE_SRC_REGISTRATION_FRAME_THRESHOLDS_H

#include <equiaffine/registration/internal/searches.h>

#include <cstddef>

namespace equiaffine::internal {

/// Limits for candidate pairs: for each point, the `neighbors` points with the nearest invariants are examined, and the
/// `best` of them are used.
struct Candidate_limits {
  std::size_t neighbors, best;
  double greatest_mismatch; ///< of gradients; mismatches are at most 1
};

/// Thresholds of the search for maps by affine frames. `benchmark_registration 84 thresholds` measures the effect of
/// most of them, by halving or doubling one at a time.
struct Frame_thresholds {
  // The points of the source with the largest weights are tried first. The weight is certainty * min(quality,
  // greatest_quality) * (least_rarity + rarity) * exp(-loss_by_disagreement * disagreement) / (1 + loss_by_condition
  // * condition) * slope.
  double greatest_quality = 0.15;
  double least_rarity = 0.05;
  double loss_by_disagreement = 3;
  double loss_by_condition = 0.002;

  // The cost of a pair is mismatch + cost_of_rest * rest + cost_of_step * step. The step, in spacings, leads along
  // the target to where the invariants agree best, and the rest is their remaining difference there.
  double cost_of_rest = 0.3;
  double cost_of_step = 0.1;
  double longest_step = 3; ///< in spacings
  Candidate_limits usual = {24, 3, 0.6};
  Candidate_limits wrong_structure = {48, 8, 0.9}; ///< if no map was found with the usual ones

  // The cost of a counterpart is residual / accidental_residual + mismatch / accidental_mismatch.
  double accidental_residual = 0.1;
  double accidental_mismatch = 0.3;
  double longest_way = 6; ///< from the candidate, in spacings

  // Order and end of the search.
  std::size_t most_points_to_try = 512, points_per_batch = 32, pairs_at_once = 8, most_hypotheses = 2000;
  /// The number of further hypotheses tried after a map has been found that moves only a part of the source onto the
  /// target within the noise: the surface may be nearly symmetric, and another map may fit better.
  std::size_t more_hypotheses = 60;

  // Thresholds on log10 of the probability that a hypothesis is a coincidence.
  std::size_t probes_at_first = 150; ///< used to judge a hypothesis before refinement
  double greatest_first_tolerance = 0.03;
  double first_log10 = -1.5;                        ///< worse hypotheses are not refined
  double second_log10 = -4;                         ///< worse hypotheses are dropped after a few steps
  double accepted_log10 = internal::accepted_log10; ///< better maps are accepted

  /// For surfaces without noise, the tolerance of spline approximations is used. Unrelated smooth surfaces can be moved
  /// onto each other to within 1e-2 of their size, and large parts of them to within 1e-3 or less.
  double exact_tolerance = 1e-5, greatest_tolerance = 3e-3, rounding = 1e-8;
};

} // namespace equiaffine::internal

#endif
