// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_COUNTERPART_H
#define EQUIAFFINE_SRC_REGISTRATION_COUNTERPART_H

#include "registration/Framed_surface_3.h"
#include "registration/candidate_pairs.h"
#include <equiaffine/registration/internal/Frame_thresholds.h>

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>

namespace equiaffine::internal {

/// A point of the source, and the point of the target that has its invariants as nearly as one nearby can.
struct Counterpart {
  std::size_t source = 0;
  Framed_point_3 target;
  double residual = 0; ///< of the invariants
  double cost = 0;     ///< 0 for a perfect pair, and 1 or 2 for an accidental one
};

/// Finds the counterpart by up to 6 steps of Gauss and Newton along the target from the candidate on, with 5 expansions
/// each: the best point on the way, since steps from wrong structure may lead astray. They end where the target has no
/// frame, and away from the candidate.
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
