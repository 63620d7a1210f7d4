// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_FRAMED_POINT_3_H
#define EQUIAFFINE_SRC_REGISTRATION_FRAMED_POINT_3_H

#include "registration/Affine_map_3.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <array>

namespace equiaffine::internal {

/// The signature of a point, which no map changes, and the logarithm of a power of the scale of its frame, which maps
/// of determinant 1 and -1 do not change either.
using Invariants = Eigen::Matrix<double, 5, 1>;
using Gradient_of_invariants = Eigen::Matrix<double, 5, 2>;

/// The number of invariants of maps of a kind.
inline int number_of_invariants(Map_kind kind) { return keeps_volume(kind) ? 5 : 4; }

/// A point of a surface with a frame that maps carry along, and the invariants around it: the affine frame, or, for
/// maps that keep angles, the Euclidean one. The scale of the frame is such that a map with the matrix A carries the tangent
/// vectors e1 and e2 to A e1 and A e2 without a weight, and the gradient, the derivatives along them, does not change.
struct Framed_point_3 {
  Eigen::Vector3d point;
  Eigen::Matrix3d basis; ///< columns e1, e2 and a transversal vector
  Invariants invariants;
  Gradient_of_invariants gradient;
  double quality = 0;       ///< 0 for a point without a frame
  double certainty = 1;     ///< of the curvatures
  bool is_elliptic = false; ///< only the affine frames of elliptic and hyperbolic points are of different kinds

  bool has_frame() const { return quality > 0; }
};

inline Eigen::Vector3d vector_of(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }

/// The map of the kind that carries one frame to the other, and its point to the other's.
inline Affine_map_3 map_between(const Framed_point_3& p, const Framed_point_3& q, Map_kind kind) {
  const Eigen::Matrix3d matrix = nearest_of_kind(q.basis * p.basis.inverse(), kind);
  return {matrix, q.point - matrix * p.point};
}

} // namespace equiaffine::internal

#endif
