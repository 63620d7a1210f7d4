// SPDX-License-Identifier: GPL-3.0-or-later
// The infinitesimal motions along which a surface slides over itself, as a result of searches for maps.
#ifndef EQUIAFFINE_REGISTRATION_AFFINE_SLIPPAGE_3_H
#define EQUIAFFINE_REGISTRATION_AFFINE_SLIPPAGE_3_H

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace equiaffine {

/// A motion p' = matrix p + translation that is tangent to a surface everywhere.
struct Infinitesimal_map_3 {
  Eigen::Matrix3d matrix;      ///< the linear part
  Eigen::Vector3d translation; ///< the other part
};

/// The infinitesimal maps along which a surface slides over itself: the Lie algebra of the continuous group of its
/// symmetries. A mesh slides as the smooth surface does that its facets stand for, to within a distance.
struct Affine_slippage_3 {
  std::vector<Infinitesimal_map_3> generators; ///< a basis
  /// The surface slides off itself by this part of its size: the rms distance of its points after motions of finite
  /// length, or, where frames of a function tell, the rms of the normal part of the velocity, beside the largest one. It
  /// is 0 where only rounding is left.
  double rms = 0;

  std::size_t dimension() const { return generators.size(); } ///< of the group; 0 if the surface does not slide
};

} // namespace equiaffine

#endif
