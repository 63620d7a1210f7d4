// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the frame at a point that maps of a kind carry along, with its invariants and their gradient.
#ifndef EQUIAFFINE_SRC_REGISTRATION_FRAMED_POINT_H
#define EQUIAFFINE_SRC_REGISTRATION_FRAMED_POINT_H

#include "registration/Framed_point_3.h"
#include "registration/derivatives_of_curvature.h"
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/geometry/affine_frame.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace equiaffine::internal {

/// The point with its affine frame e1 / sqrt(scale), e2 / sqrt(scale), xi / scale.
inline Framed_point_3 affine_framed_point(const Jet_3<double>& jet, const Eigen::Vector3d& p) {
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

/// The point with its Euclidean frame: the two principal directions, and the normal to whose side the surface is curved
/// along the first, times the length L = 1 / |(k1, k2)|, which decreases along both. The first direction is that of the
/// curvature of larger magnitude if L decreases equally fast along both, or that along which L decreases faster if both
/// magnitudes are equal, as on minimal surfaces. The signature is the other curvature, the slopes of -L along both, and
/// that of the angle of (k1, k2) along the first, all times powers of L.
inline Framed_point_3 euclidean_framed_point(const Jet_3<double>& jet, const Eigen::Vector3d& p) {
  Framed_point_3 result;
  result.point = p;
  const Derivatives_of_curvature s = derivatives_of_curvature(jet);
  const double length = 1 / s.k.norm();
  const Eigen::Vector2d k = length * s.k;
  const Eigen::Matrix2d change = length * length * s.gradient;
  const Eigen::Vector2d growth = change.transpose() * k;
  const double order = k[0] * k[0] - k[1] * k[1] + growth[0] * growth[0] - growth[1] * growth[1];
  const Eigen::Index first = order < 0 ? 1 : 0, second = 1 - first;
  const auto sign_of = [](double x) { return x < 0 ? -1. : 1.; };
  const double sign = sign_of(growth[first]), side = sign_of(k[first]);
  const double turn = sign * (k[first] * change(second, first) - k[second] * change(first, first));
  result.basis << sign * s.directions.col(first), sign_of(growth[second]) * s.directions.col(second), side * s.normal;
  result.basis *= length;
  result.invariants << side * k[second], std::abs(growth[first]), std::abs(growth[second]), turn, std::log(length);
  if (result.basis.allFinite() && result.invariants.allFinite())
    result.quality = std::min({std::abs(order), std::abs(k[first]), k[0] - k[1], growth.cwiseAbs().minCoeff()});
  return result;
}

/// The point with its frame, but without the gradient.
inline Framed_point_3 framed_point_of(const Jet_3<double>& jet, const Eigen::Vector3d& p, Map_kind kind) {
  return keeps_angles(kind) ? euclidean_framed_point(jet, p) : affine_framed_point(jet, p);
}

/// The step of differences in units of the tangent vectors of `Framed_point_3::basis`. Errors of gradients are some
/// 1e-5 of their size: they only choose between candidates and direct Newton's steps.
constexpr double step_of_gradient = 0x1p-8;

/// Computes the point with its frame and gradient, by 5 expansions taylor(p). A map carries the points of these
/// differences along.
template <class Taylor>
Framed_point_3 framed_point(const Taylor& taylor, const Eigen::Vector3d& p, Map_kind kind) {
  Framed_point_3 result = framed_point_of(taylor(p), p, kind);
  for (int i = 0; i < 2 && result.has_frame(); ++i) {
    const Eigen::Vector3d step = step_of_gradient * result.basis.col(i);
    const Framed_point_3 ahead = framed_point_of(taylor(p + step), p + step, kind);
    const Framed_point_3 behind = framed_point_of(taylor(p - step), p - step, kind);
    const bool is_smooth = ahead.has_frame() && behind.has_frame() && ahead.is_elliptic == result.is_elliptic &&
                           behind.is_elliptic == result.is_elliptic;
    if (!is_smooth) result.quality = 0;
    else result.gradient.col(i) = (ahead.invariants - behind.invariants) / (2 * step_of_gradient);
  }
  return result;
}

} // namespace equiaffine::internal

#endif
