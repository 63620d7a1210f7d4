// SPDX-License-Identifier: GPL-3.0-or-later
// The thresholds and limits of the search for maps by affine frames.
#ifndef EQUIAFFINE_SRC_REGISTRATION_FRAME_THRESHOLDS_H
#define EQUIAFFINE_SRC_REGISTRATION_FRAME_THRESHOLDS_H

#include <equiaffine/registration/internal/searches.h>

#include <cstddef>

namespace equiaffine::internal {

/// How many pairs are made, and of what points: of the `neighbors` nearest in invariants, the `best` of each point.
struct Candidate_limits {
  std::size_t neighbors, best;
  double greatest_mismatch; ///< of gradients, whose mismatch is 1 at most
};

/// The thresholds of the search for maps by affine frames. `benchmark_registration 84 thresholds` shows what most of
/// them are good for, with one of them halved or doubled at a time.
struct Frame_thresholds {
  // The points of the source with the greatest weights are tried first: certainty * min(quality, greatest_quality) *
  // (least_rarity + rarity) * exp(-loss_by_disagreement * disagreement) / (1 + loss_by_condition * condition) * slope.
  double greatest_quality = 0.15;
  double least_rarity = 0.05;
  double loss_by_disagreement = 3;
  double loss_by_condition = 0.002;

  // A pair costs mismatch + cost_of_rest * rest + cost_of_step * step. The step, in spacings, leads along the target to
  // where the invariants agree best, and the rest is how much they still differ there.
  double cost_of_rest = 0.3;
  double cost_of_step = 0.1;
  double longest_step = 3; ///< in spacings
  Candidate_limits usual = {24, 3, 0.6};
  Candidate_limits wrong_structure = {48, 8, 0.9}; ///< where no map was found by the usual ones

  // A counterpart costs residual / accidental_residual + mismatch / accidental_mismatch.
  double accidental_residual = 0.1;
  double accidental_mismatch = 0.3;
  double longest_way = 6; ///< from the candidate, in spacings

  // The order and the end of the search.
  std::size_t most_points_to_try = 512, points_per_batch = 32, pairs_at_once = 8, most_hypotheses = 2000;
  /// So many hypotheses more are tried after a map that moves only a part of the source to within the noise: the
  /// surface may be nearly symmetric, and another map fit better.
  std::size_t more_hypotheses = 60;

  // A hypothesis has to reach these logarithms of the chance that it is an accident.
  std::size_t probes_at_first = 150; ///< by which a hypothesis is judged before it is refined
  double greatest_first_tolerance = 0.03;
  double first_log10 = -1.5;                        ///< hypotheses that are no better are not refined
  double second_log10 = -4;                         ///< those that are no better after a few steps are given up
  double accepted_log10 = internal::accepted_log10; ///< a map that is better is no accident

  /// The tolerance of surfaces without noise is that of splines through samples. Smooth surfaces that have nothing in
  /// common can be moved onto each other to within 1e-2 of their size, and large parts of them to within 1e-3 or less.
  double exact_tolerance = 1e-5, greatest_tolerance = 3e-3, rounding = 1e-8;
};

} // namespace equiaffine::internal

#endif
