// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_FRAMED_POINT_3_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_FRAMED_POINT_3_H

#include <equiaffine/geometry/affine_frame.h>
#include <equiaffine/geometry/local_structure.h>
#include <equiaffine/registration/internal/Affine_map_3.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>

namespace equiaffine::internal {

/// The signature of a point, which no affine map changes, and half the logarithm of the scale of its frame, which maps
/// of determinant 1 and -1 do not change either.
using Invariants = Eigen::Matrix<double, 5, 1>;
using Gradient_of_invariants = Eigen::Matrix<double, 5, 2>;

/// The number of invariants of maps of a kind.
inline int number_of_invariants(Map_kind kind) { return keeps_volume(kind) ? 5 : 4; }

/// A point of a surface with its affine frame and the invariants around it. The tangent vectors of `basis` are divided
/// by the root of the scale, so that an affine map A carries them to A e1 and A e2 without a weight, and the gradient,
/// the derivatives along them, does not change.
struct Framed_point_3 {
  Eigen::Vector3d point;
  Eigen::Matrix3d basis; ///< columns e1 / sqrt(scale), e2 / sqrt(scale), xi / scale
  Invariants invariants;
  Gradient_of_invariants gradient;
  double quality = 0;   ///< 0 for a point without a frame
  double certainty = 1; ///< of the curvatures
  bool is_elliptic = false;

  bool has_frame() const { return quality > 0; }
};

inline Eigen::Vector3d vector_of(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }

/// The point with its frame, but without the gradient.
inline Framed_point_3 framed_point_of(const Jet_3<double>& jet, const Eigen::Vector3d& p) {
  Framed_point_3 result;
  result.point = p;
  const auto structure = regular_structure<double>(jet, {p[0], p[1], p[2]});
  if (!structure.is_regular) return result;
  const Affine_frame_3<double> frame = affine_frame(structure.structure.affine);
  const double root = std::sqrt(frame.scale);
  result.basis << vector_of(frame.e1) / root, vector_of(frame.e2) / root, vector_of(frame.xi) / frame.scale;
  result.invariants << Eigen::Map<const Eigen::Vector4d>(frame.signature.data()), std::log(root);
  result.is_elliptic = frame.is_elliptic;
  result.quality = result.basis.allFinite() && result.invariants.allFinite() ? frame.quality : 0;
  return result;
}

/// The step of differences in units of the tangent vectors of `Framed_point_3::basis`. Errors of gradients are some
/// 1e-5 of their size: they only choose between candidates and direct Newton's steps.
constexpr double step_of_gradient = 0x1p-8;

/// Computes the point with its frame and gradient, by 5 expansions taylor(p). An affine map carries the points of these
/// differences along.
template <class Taylor>
Framed_point_3 framed_point(const Taylor& taylor, const Eigen::Vector3d& p) {
  Framed_point_3 result = framed_point_of(taylor(p), p);
  for (int i = 0; i < 2 && result.has_frame(); ++i) {
    const Eigen::Vector3d step = step_of_gradient * result.basis.col(i);
    const Framed_point_3 ahead = framed_point_of(taylor(p + step), p + step);
    const Framed_point_3 behind = framed_point_of(taylor(p - step), p - step);
    const bool is_smooth = ahead.has_frame() && behind.has_frame() && ahead.is_elliptic == result.is_elliptic &&
                           behind.is_elliptic == result.is_elliptic;
    if (!is_smooth) result.quality = 0;
    else result.gradient.col(i) = (ahead.invariants - behind.invariants) / (2 * step_of_gradient);
  }
  return result;
}

/// The affine map that carries one frame to the other, and its point to the other's.
inline Affine_map_3 map_between(const Framed_point_3& p, const Framed_point_3& q, Map_kind kind) {
  const Eigen::Matrix3d matrix = nearest_of_kind(q.basis * p.basis.inverse(), kind);
  return {matrix, q.point - matrix * p.point};
}

} // namespace equiaffine::internal

#endif
