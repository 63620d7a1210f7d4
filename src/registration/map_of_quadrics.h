// SPDX-License-Identifier: GPL-3.0-or-later
// One of the many maps between two quadrics of the same kind, which have no affine frames. Each is moved to its
// normal form, z1^2 + z2^2 + z3^2 = 1 and so on with other signs, or +-z1^2 +- z2^2 = z3.
#ifndef EQUIAFFINE_SRC_REGISTRATION_MAP_OF_QUADRICS_H
#define EQUIAFFINE_SRC_REGISTRATION_MAP_OF_QUADRICS_H

#include "registration/Affine_map_3.h"
#include "registration/Framed_surface_3.h"
#include <equiaffine/registration/register_surfaces.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// x^T form x + 2 linear . x + constant = 0.
struct Quadric_3 {
  Eigen::Matrix3d form;
  Eigen::Vector3d linear;
  double constant;
};

/// A map to the normal form of a quadric, and the signs there.
struct Normal_quadric_3 {
  Affine_map_3 map;
  int positive, negative; ///< numbers of squares; 2 in total for a paraboloid
};

/// Returns the least squares quadric of points, if it is close to all of them, to within a fraction of their size,
/// and unique. The centroid and the size of the points must be about 0 and 1.
inline std::optional<Quadric_3> quadric_near(const std::vector<Eigen::Vector3d>& points, double tolerance) {
  Eigen::MatrixXd rows(Eigen::Index(points.size()), 10);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& x = points[i];
    rows.row(Eigen::Index(i)) << x[0] * x[0], x[1] * x[1], x[2] * x[2], 2 * x[0] * x[1], 2 * x[0] * x[2],
        2 * x[1] * x[2], 2 * x[0], 2 * x[1], 2 * x[2], 1;
  }
  if (rows.rows() < 10) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeThinV);
  const auto& values = svd.singularValues();
  if (values[9] > tolerance * values[0] || values[8] <= tolerance * values[0]) return std::nullopt;
  const Eigen::VectorXd c = svd.matrixV().col(9);
  Quadric_3 quadric;
  quadric.form << c[0], c[3], c[4], c[3], c[1], c[5], c[4], c[5], c[2];
  quadric.linear = c.segment<3>(6);
  quadric.constant = c[9];
  return quadric;
}

/// Returns the map to the normal form of an ellipsoid, hyperboloid, or paraboloid; nothing for cones and cylinders.
inline std::optional<Normal_quadric_3> normal_form(const Quadric_3& quadric) {
  constexpr double rounding = 1e-7;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(quadric.form);
  const Eigen::Vector3d values = solver.eigenvalues(), linear = solver.eigenvectors().transpose() * quadric.linear;
  const double largest = values.cwiseAbs().maxCoeff();
  Eigen::Vector3i order(0, 1, 2); // squares with a nonzero coefficient first
  std::sort(order.begin(), order.end(), [&](int a, int b) { return std::abs(values[a]) > std::abs(values[b]); });
  const bool is_central = std::abs(values[order[2]]) > rounding * largest;
  const int squares = is_central ? 3 : 2;
  if (std::abs(values[order[1]]) <= rounding * largest) return std::nullopt;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double constant = quadric.constant;
  for (int k = 0; k < squares; ++k) {
    center[order[k]] = -linear[order[k]] / values[order[k]];
    constant += linear[order[k]] * center[order[k]];
  }
  double unit = -constant; // of the squares: their sum equals it, or the linear term times it
  if (!is_central) {
    const double slope = 2 * linear[order[2]];
    if (std::abs(slope) <= rounding * largest) return std::nullopt;
    center[order[2]] = -constant / slope;
    unit = values[order[0]] + values[order[1]] > 0 ? 1 : -1;
  }
  if (std::abs(unit) <= rounding * largest) return std::nullopt;
  Eigen::Vector3d rank = values / unit; // sort key of the squares
  if (!is_central) rank[order[2]] = -std::numeric_limits<double>::infinity();
  std::sort(order.begin(), order.end(), [&](int a, int b) { return rank[a] > rank[b]; });
  Normal_quadric_3 result{{}, 0, 0};
  for (int k = 0; k < 3; ++k) {
    const double scaled = values[order[k]] / unit;
    const bool is_square = k < squares;
    if (is_square) (scaled > 0 ? result.positive : result.negative)++;
    const double factor = is_square ? std::sqrt(std::abs(scaled)) : -2 * linear[order[2]] / unit;
    result.map.matrix.row(k) = factor * solver.eigenvectors().col(order[k]).transpose();
    result.map.translation[k] = -factor * center[order[k]];
  }
  return result;
}

inline std::optional<Normal_quadric_3> normal_form_of(const Framed_surface_3& surface) {
  constexpr double rounding = 1e-9;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : surface.probes) mean += p / double(surface.probes.size());
  const Affine_map_3 centering = {Eigen::Matrix3d::Identity() / surface.size, -mean / surface.size};
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : surface.probes) points.push_back(centering(p));
  const auto quadric = quadric_near(points, rounding);
  auto result = quadric ? normal_form(*quadric) : std::nullopt;
  if (result) result->map = result->map * centering;
  return result;
}

/// Returns a map of a kind if both surfaces are quadrics with the same signs in their normal forms.
inline std::optional<Affine_map_3> map_of_quadrics(const Framed_surface_3& source, const Framed_surface_3& target,
                                                   const Registration_options& options) {
  const auto from = normal_form_of(source), to = normal_form_of(target);
  if (!from || !to || from->positive != to->positive || from->negative != to->negative) return std::nullopt;
  Affine_map_3 mirror;
  const bool has_to_turn = from->map.matrix.determinant() * to->map.matrix.determinant() < 0;
  if (has_to_turn && !options.reflections) mirror.matrix(0, 0) = -1;
  Affine_map_3 map = to->map.inverse() * mirror * from->map;
  const Eigen::Vector3d image = map(source.probes.front());
  map.matrix = nearest_of_kind(map.matrix, options.kind);
  map.translation = image - map.matrix * source.probes.front();
  return map;
}

} // namespace equiaffine::internal

#endif
