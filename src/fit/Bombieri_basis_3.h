// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_BOMBIERI_BASIS_3_H
#define EQUIAFFINE_SRC_FIT_BOMBIERI_BASIS_3_H

#include "fit/Patch_3.h"
#include "fit/monomial_moments.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace equiaffine::internal {

constexpr int maximal_space_degree = 7;

/// The monomials x^i y^j z^k of total degree n up to 7, ordered by degree, each times the root of n! / (i! j! k!). Sums
/// of squares of coefficients beside them do not change when space is rotated (Bombieri's norm).
class Bombieri_basis_3 {
public:
  static constexpr std::size_t size = number_of_coefficients(Fit_family::SPACE, maximal_space_degree);

  struct Element {
    int i, j, k;
    double factor;
  };

  Bombieri_basis_3() {
    std::size_t m = 0;
    for (int n = 0; n <= maximal_space_degree; ++n)
      for (int i = n; i >= 0; --i)
        for (int j = n - i; j >= 0; --j, ++m)
          elements_[m] = {i, j, n - i - j, std::sqrt(binomial(n, i) * binomial(n - i, j))};
  }

  static double binomial(int n, int k) {
    double result = 1;
    for (int i = 0; i < k; ++i) result = result * (n - i) / (i + 1);
    return result;
  }

  const Element& operator[](std::size_t m) const { return elements_[m]; }

  /// Returns the weighted sums of products of values of the elements up to a degree.
  Eigen::MatrixXd products(const Monomial_moments& moments, int degree) const {
    return symmetric_matrix(degree, [&](const Element& a, const Element& b) {
      return moments.of_points[position_of_monomial(a.i + b.i, a.j + b.j, a.k + b.k)];
    });
  }

  /// Returns the weighted sums of products of derivatives along the normals.
  Eigen::MatrixXd products_of_derivatives(const Monomial_moments& moments, int degree) const {
    return symmetric_matrix(degree, [&](const Element& a, const Element& b) {
      const std::array<int, 3> p = {a.i, a.j, a.k}, q = {b.i, b.j, b.k};
      double sum = 0;
      for (std::size_t u = 0; u < 3; ++u)
        for (std::size_t v = 0; v < 3; ++v) {
          if (p[u] * q[v] == 0) continue;
          std::array<int, 3> power = {p[0] + q[0], p[1] + q[1], p[2] + q[2]};
          --power[u];
          --power[v];
          const auto [low, high] = std::minmax(u, v);
          sum += p[u] * q[v] *
                 moments.of_normals(position_of_monomial(power[0], power[1], power[2]),
                                    Eigen::Index(low == 0 ? high : 2 * low + high - (low == 2)));
        }
      return sum;
    });
  }

  /// Returns the weighted sums of derivatives along the normals.
  Eigen::VectorXd derivatives(const Monomial_moments& moments, int degree) const {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(number_of_monomials_3(degree));
    for (Eigen::Index m = 0; m < result.size(); ++m) {
      const auto& [i, j, k, factor] = elements_[std::size_t(m)];
      if (i > 0) result[m] += factor * i * moments.of_normals(position_of_monomial(i - 1, j, k), 6);
      if (j > 0) result[m] += factor * j * moments.of_normals(position_of_monomial(i, j - 1, k), 7);
      if (k > 0) result[m] += factor * k * moments.of_normals(position_of_monomial(i, j, k - 1), 8);
    }
    return result;
  }

private:
  template <class Entry>
  Eigen::MatrixXd symmetric_matrix(int degree, const Entry& entry) const {
    const Eigen::Index count = number_of_monomials_3(degree);
    Eigen::MatrixXd result(count, count);
    for (Eigen::Index m = 0; m < count; ++m)
      for (Eigen::Index n = 0; n <= m; ++n) {
        const auto &a = elements_[std::size_t(m)], &b = elements_[std::size_t(n)];
        result(m, n) = result(n, m) = a.factor * b.factor * entry(a, b);
      }
    return result;
  }

  std::array<Element, size> elements_;
};

inline const Bombieri_basis_3 bombieri_basis_3;

} // namespace equiaffine::internal

#endif
