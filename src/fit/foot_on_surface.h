// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_FOOT_ON_SURFACE_H
#define EQUIAFFINE_SRC_FIT_FOOT_ON_SURFACE_H

#include <equiaffine/surface/internal/jet_derivatives.h>

#include <Eigen/Core>

#include <optional>

namespace equiaffine {

/// The end of Newton's steps along the gradient.
struct Foot_3 {
  Eigen::Vector3d point;    ///< on the zero set, to within the length of a further step
  Eigen::Vector3d before;   ///< the point from which the last step led there
  Eigen::Vector3d gradient; ///< of the function at `before`
};

/// Moves a point along gradients to the zero set of a function, whose jets are `jet_at(p)`, until a step is not longer
/// than `least_step`. There is no foot if a step is not shorter than `greatest_step(p)`, or if `most_steps` do not end.
template <class Jet_at, class Greatest_step>
std::optional<Foot_3> foot_on_surface(Eigen::Vector3d p, const Jet_at& jet_at, const Greatest_step& greatest_step,
                                      double least_step, int most_steps) {
  for (int n = 0; n < most_steps; ++n) {
    const auto jet = jet_at(p);
    const Eigen::Vector3d gradient = eigen_gradient(jet);
    const Eigen::Vector3d step = jet.value() * gradient / gradient.squaredNorm();
    const double length = step.norm();
    if (!(length < greatest_step(p))) return {};
    if (length <= least_step) return Foot_3{p - step, p, gradient};
    p -= step;
  }
  return {};
}

} // namespace equiaffine

#endif
