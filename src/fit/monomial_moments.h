// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_MONOMIAL_MOMENTS_H
#define EQUIAFFINE_SRC_FIT_MONOMIAL_MOMENTS_H

#include "fit/Data_points_3.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace equiaffine::internal {

/// The weight of a point in a fit, at a distance from the center given in radii: 1 - distance^2, and not quite zero.
inline double fit_weight(double squared_distance) { return std::max(1e-9, 1 - squared_distance); }

/// The number of monomials x^i y^j z^k of total degree up to `degree`.
constexpr Eigen::Index number_of_monomials_3(int degree) {
  return Eigen::Index((degree + 1) * (degree + 2) * (degree + 3) / 6);
}

/// The position of x^i y^j z^k among monomials that are ordered by degree, then by descending i and j.
constexpr Eigen::Index position_of_monomial(int i, int j, int k) {
  const int n = i + j + k, s = n - i;
  return (n > 0 ? number_of_monomials_3(n - 1) : 0) + Eigen::Index(s * (s + 1) / 2 + k);
}

/// Sums over the points of a ball, of weights times monomials and products of components of the normal, from which
/// polynomials of degree d have their normal equations. There are far fewer of them than products of pairs of monomials.
struct Monomial_moments {
  Eigen::VectorXd of_points; ///< of monomials up to degree 2 d
  /// These are of monomials up to degree 2 d - 2 times n_x n_x, n_x n_y, n_x n_z, n_y n_y, n_y n_z, n_z n_z, n_x, n_y
  /// and n_z.
  Eigen::Matrix<double, Eigen::Dynamic, 9> of_normals;
};

/// The moments for polynomials of that degree, with coordinates in radii about the center.
inline Monomial_moments monomial_moments(const Data_points_3& data, std::span<const Data_points_3::Index> ball,
                                         const Eigen::Vector3d& center, double radius, int degree) {
  constexpr Eigen::Index block = 64;
  const Eigen::Index all = number_of_monomials_3(2 * degree), with_normals = number_of_monomials_3(2 * degree - 2);
  Eigen::Matrix<double, block, Eigen::Dynamic> values(block, all);
  Eigen::Matrix<double, block, 3> local;
  Eigen::Matrix<double, block, 9> normals;
  Monomial_moments moments{Eigen::VectorXd::Zero(all), Eigen::MatrixXd::Zero(with_normals, 9)};
  for (std::size_t begin = 0; begin < ball.size(); begin += std::size_t(block)) {
    const Eigen::Index count = std::min(block, Eigen::Index(ball.size() - begin));
    if (count < block) local.setZero(), normals.setZero(), values.col(0).setZero();
    for (Eigen::Index l = 0; l < count; ++l) {
      const auto i = ball[begin + std::size_t(l)];
      const Eigen::Vector3d p = (data.points[i] - center) / radius, &n = data.normals[i];
      local.row(l) = p;
      normals.row(l) << n[0] * n[0], n[0] * n[1], n[0] * n[2], n[1] * n[1], n[1] * n[2], n[2] * n[2], n[0], n[1], n[2];
      values(l, 0) = fit_weight(p.squaredNorm());
    }
    Eigen::Index next = 1, before = 0; // the first monomials of this degree and of the one before
    for (Eigen::Index n = 1; n <= 2 * degree; ++n) {
      const auto raise = [&](Eigen::Index from, Eigen::Index axis) {
        values.col(next++) = values.col(from).cwiseProduct(local.col(axis));
      };
      const Eigen::Index first = next, of_plane = n * (n + 1) / 2;
      for (Eigen::Index q = 0; q < of_plane; ++q) raise(before + q, 0);
      for (Eigen::Index q = of_plane - n; q < of_plane; ++q) raise(before + q, 1);
      raise(first - 1, 2);
      before = first;
    }
    moments.of_points += values.colwise().sum().transpose();
    moments.of_normals.noalias() += values.leftCols(with_normals).transpose() * normals;
  }
  return moments;
}

} // namespace equiaffine::internal

#endif
