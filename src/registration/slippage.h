// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the infinitesimal maps along which a surface slides over itself.
#ifndef EQUIAFFINE_SRC_REGISTRATION_SLIPPAGE_H
#define EQUIAFFINE_SRC_REGISTRATION_SLIPPAGE_H

#include "registration/Affine_map_3.h"
#include "registration/Framed_surface_3.h"
#include "registration/refine_map.h"
#include <equiaffine/registration/slippage_of_mesh.h>

#include <Eigen/Core>
#include <Eigen/SVD>

#include <algorithm>
#include <cstddef>
#include <unsupported/Eigen/MatrixFunctions>
#include <vector>

namespace equiaffine::internal {

/// By default, singular values below this fraction of the largest one count as zero: those of a surface that slides over
/// itself are rounding errors, and those of an ellipsoid with a relative perturbation of 1e-4 are 1e-5.
constexpr double slippage_tolerance = 1e-8;

/// The thresholds for formulas, which have rounding errors, and for fits, whose normals have errors.
constexpr double exact_slippage = 3e-13, slippage_of_fits = 0.01;

/// Infinitesimal maps, the best slippages first, and the rms normal velocity of each, relative to the largest.
struct Sliding_maps {
  std::vector<Infinitesimal_map_3> maps;
  std::vector<double> rms;

  /// The first maps as a Lie algebra.
  Affine_slippage_3 first(std::size_t dimension) const {
    if (dimension == 0) return {};
    return {{maps.begin(), maps.begin() + std::ptrdiff_t(dimension)}, rms[dimension - 1]};
  }
};

/// Computes the singular vectors of the matrix with a row normal . (M p + c) per point, for the maps of a kind, in the
/// coordinates of the surface (for rigid maps: Gelfand, Guibas, Shape segmentation using local slippage analysis, 2004).
/// `size` is the size of the surface; there are no maps if it lies in a plane.
inline Sliding_maps sliding_maps(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<Eigen::Vector3d>& normals, Map_kind kind, double size) {
  Sliding_maps result;
  if (points.size() < 16) return result;
  const Whitening whitening(points);
  if (!whitening.matrix.allFinite()) return result;
  const Eigen::MatrixXd maps = infinitesimal_maps(kind);
  Eigen::MatrixXd rows(Eigen::Index(points.size()), 12);
  const bool is_affine = !keeps_angles(kind);
  const Eigen::Matrix3d to = is_affine ? whitening.matrix : Eigen::Matrix3d(Eigen::Matrix3d::Identity() / size);
  const Eigen::Matrix3d from = is_affine ? whitening.inverse : Eigen::Matrix3d(Eigen::Matrix3d::Identity() * size);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d x = to * (points[i] - whitening.mean);
    const Eigen::Vector3d n = (from.transpose() * normals[i]).normalized();
    for (int k = 0; k < 3; ++k) rows.row(Eigen::Index(i)).segment<3>(3 * k) = n[k] * x.transpose();
    rows.row(Eigen::Index(i)).tail<3>() = n.transpose();
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows * maps, Eigen::ComputeThinV);
  const auto& values = svd.singularValues();
  for (Eigen::Index k = values.size() - 1; k >= 0; --k) {
    const Eigen::Matrix<double, 12, 1> v = maps * svd.matrixV().col(k);
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i) m.row(i) = v.segment<3>(3 * i).transpose();
    const Eigen::Matrix3d matrix = from * m * to;
    result.maps.push_back({matrix, from * v.tail<3>() - matrix * whitening.mean});
    result.rms.push_back(values[k] / values[0]);
  }
  return result;
}

/// The flow of an infinitesimal map at a given time.
inline Affine_map_3 flow(const Infinitesimal_map_3& velocity, double time) {
  Eigen::Matrix4d generator = Eigen::Matrix4d::Zero();
  generator.topLeftCorner<3, 3>() = time * velocity.matrix;
  generator.topRightCorner<3, 1>() = time * velocity.translation;
  const Eigen::Matrix4d map = generator.exp();
  return {map.topLeftCorner<3, 3>(), map.topRightCorner<3, 1>()};
}

/// The maps of a kind whose velocities are tangent at all points, to within a tolerance relative to the largest one.
inline Affine_slippage_3 slippage_of(const Framed_surface_3& surface, Map_kind kind, double tolerance) {
  std::vector<Eigen::Vector3d> normals;
  for (const Eigen::Vector3d& p : surface.probes) normals.push_back(surface.refinement.distance(p).normal);
  const Sliding_maps maps = sliding_maps(surface.probes, normals, kind, surface.size);
  const auto end = std::find_if(maps.rms.begin(), maps.rms.end(), [=](double rms) { return !(rms < tolerance); });
  return maps.first(std::size_t(end - maps.rms.begin()));
}

} // namespace equiaffine::internal

#endif
