// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_FRAMES_SLIPPAGE_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_FRAMES_SLIPPAGE_H

#include <equiaffine/registration/Affine_slippage_3.h>
#include <equiaffine/registration/internal/frames/Framed_surface_3.h>
#include <equiaffine/registration/internal/frames/Whitening.h>
#include <equiaffine/registration/internal/frames/refine_map.h>

#include <Eigen/Core>
#include <Eigen/SVD>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Singular values below this part of the largest one count as zero by default: those of a surface that slips are
/// roundings, and those of an ellipsoid that is disturbed by a part of 1e-4 are 1e-5.
constexpr double slippage_tolerance = 1e-8;

/// The thresholds for formulas, whose values are roundings, and for fits, whose normals have errors.
constexpr double exact_slippage = 3e-13, slippage_of_fits = 0.01;

/// A Lie algebra of maps along which a surface slides, and the rms of the part of their velocity that is not tangent.
struct Slippage {
  Affine_slippage_3 algebra;
  double rms = 0;
};

/// The maps of a kind, in coordinates of the surface, whose velocity at all points is tangent: null vectors of the
/// matrix with a row normal . (M p + c) per point (Gelfand, Guibas: Shape segmentation using local slippage analysis,
/// 2004, for rigid maps).
inline Slippage slippage_of(const Framed_surface_3& surface, Map_kind kind, double tolerance) {
  const auto& points = surface.probes;
  Slippage result;
  if (points.size() < 16) return result;
  const Whitening whitening(points);
  if (!whitening.matrix.allFinite()) return result;
  const Eigen::MatrixXd maps = infinitesimal_maps(kind);
  Eigen::MatrixXd rows(Eigen::Index(points.size()), 12);
  const bool is_affine = !keeps_angles(kind);
  const Eigen::Matrix3d to = is_affine ? whitening.matrix : Eigen::Matrix3d(Eigen::Matrix3d::Identity() / surface.size);
  const Eigen::Matrix3d from =
      is_affine ? whitening.inverse : Eigen::Matrix3d(Eigen::Matrix3d::Identity() * surface.size);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d x = to * (points[i] - whitening.mean);
    const Eigen::Vector3d n = (from.transpose() * surface.refinement.distance(points[i]).normal).normalized();
    for (int k = 0; k < 3; ++k) rows.row(Eigen::Index(i)).segment<3>(3 * k) = n[k] * x.transpose();
    rows.row(Eigen::Index(i)).tail<3>() = n.transpose();
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows * maps, Eigen::ComputeThinV);
  const auto& values = svd.singularValues();
  for (Eigen::Index k = values.size() - 1; k >= 0 && values[k] < tolerance * values[0]; --k) {
    result.rms = std::max(result.rms, values[k] / values[0]);
    const Eigen::Matrix<double, 12, 1> v = maps * svd.matrixV().col(k);
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i) m.row(i) = v.segment<3>(3 * i).transpose();
    const Eigen::Matrix3d matrix = from * m * to;
    result.algebra.generators.push_back({matrix, from * v.tail<3>() - matrix * whitening.mean});
  }
  return result;
}

} // namespace equiaffine::internal

#endif
