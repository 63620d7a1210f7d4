// SPDX-License-Identifier: GPL-3.0-or-later
// Fits polynomials in space, whose zero set is the surface, to the points of a ball and their normals.
#ifndef EQUIAFFINE_SRC_FIT_FIT_SPACE_H
#define EQUIAFFINE_SRC_FIT_FIT_SPACE_H

#include "fit/Data_points_3.h"
#include "fit/Local_fit_3.h"
#include <equiaffine/number/internal/monomials_3.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// The weight of a point at a distance, in radii, from the center: 1 - distance^2, but always positive.
inline double fit_weight(double squared_distance) { return std::max(1e-9, 1 - squared_distance); }

/// The number of monomials x^i y^j z^k of total degree up to `degree`.
constexpr Eigen::Index number_of_monomials_3(int degree) {
  return Eigen::Index((degree + 1) * (degree + 2) * (degree + 3) / 6);
}

/// The position of x^i y^j z^k among monomials ordered by degree, then by descending i and j.
constexpr Eigen::Index position_of_monomial(int i, int j, int k) {
  const int n = i + j + k, s = n - i;
  return (n > 0 ? number_of_monomials_3(n - 1) : 0) + Eigen::Index(s * (s + 1) / 2 + k);
}

/// Weighted sums over the points of a ball of monomials and products of normal components, from which the normal
/// equations of polynomials of degree d are assembled. They are far fewer than the products of pairs of monomials.
struct Monomial_moments {
  Eigen::VectorXd of_points; ///< of monomials up to degree 2 d
  /// Of monomials up to degree 2 d - 2 times n_x n_x, n_x n_y, n_x n_z, n_y n_y, n_y n_z, n_z n_z, n_x, n_y and n_z.
  Eigen::Matrix<double, Eigen::Dynamic, 9> of_normals;
};

/// The moments for polynomials of that degree, with coordinates in radii around the center.
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
    Eigen::Index next = 1, before = 0; // the first monomials of this degree and of the previous one
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

constexpr int maximal_space_degree = 7;

/// The monomials x^i y^j z^k of total degree n up to 7, ordered by degree, each times the square root of n! / (i! j!
/// k!). With respect to this basis the sum of the squared coefficients is invariant under rotations (Bombieri's
/// norm).
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

/// The conditions at the points of a ball: f is zero, and its derivative along the normal is 1.
struct Space_system {
  Eigen::MatrixXd values, derivatives; ///< a column per point, times the square root of its weight
  Eigen::VectorXd roots_of_weights;
  Eigen::VectorXd noise;  ///< in radii; empty if unknown
  std::size_t points = 0; ///< of the ball, including those without a column here

  double part() const { return double(values.cols()) / double(points); }
};

inline Space_system space_system(const Data_points_3& data, std::span<const Data_points_3::Index> ball,
                                 const Eigen::Vector3d& center, double radius, int degree) {
  const std::size_t count = number_of_coefficients(Fit_family::SPACE, degree);
  Space_system system;
  system.values.resize(Eigen::Index(count), Eigen::Index(ball.size()));
  system.derivatives.resize(Eigen::Index(count), Eigen::Index(ball.size()));
  system.roots_of_weights.resize(Eigen::Index(ball.size()));
  for (std::size_t p = 0; p < ball.size(); ++p) {
    const Eigen::Vector3d local = (data.points[ball[p]] - center) / radius, normal = data.normals[ball[p]];
    const double root = std::sqrt(fit_weight(local.squaredNorm()));
    std::array<std::array<double, maximal_space_degree + 1>, 3> power, slope;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      power[axis][0] = 1;
      slope[axis][0] = 0;
      for (std::size_t n = 0; n < std::size_t(degree); ++n) {
        power[axis][n + 1] = power[axis][n] * local[Eigen::Index(axis)];
        slope[axis][n + 1] = double(n + 1) * power[axis][n] * normal[Eigen::Index(axis)];
      }
    }
    double* const value = system.values.col(Eigen::Index(p)).data();
    double* const derivative = system.derivatives.col(Eigen::Index(p)).data();
    for (std::size_t m = 0; m < count; ++m) {
      const auto& e = bombieri_basis_3[m];
      const auto i = std::size_t(e.i), j = std::size_t(e.j), k = std::size_t(e.k);
      const double xy = power[0][i] * power[1][j], scale = root * e.factor;
      value[m] = scale * xy * power[2][k];
      derivative[m] =
          scale * ((slope[0][i] * power[1][j] + power[0][i] * slope[1][j]) * power[2][k] + xy * slope[2][k]);
    }
    system.roots_of_weights[Eigen::Index(p)] = root;
  }
  return system;
}

/// Returns the coefficients of x^i y^j z^k in the order of Patch_3.
inline std::vector<double> space_coefficients(const Eigen::VectorXd& bombieri, int degree) {
  std::vector<double> coefficients(std::size_t(bombieri.size()));
  std::array<std::array<std::array<std::size_t, maximal_space_degree + 1>, maximal_space_degree + 1>,
             maximal_space_degree + 1>
      position;
  std::size_t next = 0;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= degree; ++k) position[std::size_t(i)][std::size_t(j)][std::size_t(k)] = next++;
  for (Eigen::Index m = 0; m < bombieri.size(); ++m) {
    const auto& e = bombieri_basis_3[std::size_t(m)];
    coefficients[position[std::size_t(e.i)][std::size_t(e.j)][std::size_t(e.k)]] = bombieri[m] * e.factor;
  }
  return coefficients;
}

/// Moves from the center of a patch along gradients to its zero set, within a quarter of the radius. Both points are
/// in local coordinates. `jet` is set to the jet at the result.
inline std::optional<Eigen::Vector3d> foot_of_center(const Patch_3& patch, Jet_3<double>& jet) {
  const auto foot = foot_on_surface(
      Eigen::Vector3d::Zero(), [&](const Eigen::Vector3d& p) { return jet = space_taylor<4>(patch, p); },
      [](const Eigen::Vector3d&) { return 0.25; }, 1e-8, 8);
  return foot ? std::optional(foot->before) : std::nullopt;
}

/// The derivatives of numbers at a point with respect to the coefficients of the basis, one number per column.
inline Eigen::MatrixXd space_gradient(const Number_gradient& gradient, const Eigen::Vector3d& p, std::size_t count) {
  std::array<std::array<std::array<double, 5>, maximal_space_degree + 1>, 3> taylor = {}; // of t^n along every axis
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int n = 0; n <= maximal_space_degree; ++n)
      for (int k = 0; k <= std::min(n, 4); ++k)
        taylor[axis][std::size_t(n)][std::size_t(k)] =
            Bombieri_basis_3::binomial(n, k) * std::pow(p[Eigen::Index(axis)], n - k);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(Eigen::Index(count), gradient.cols());
  for (std::size_t m = 0; m < count; ++m) {
    const auto& e = bombieri_basis_3[m];
    for (std::size_t n = 1; n < Jet_3<double>::size; ++n) {
      const auto [i, j, k] = monomials[n];
      const double t = e.factor * taylor[0][std::size_t(e.i)][std::size_t(i)] *
                       taylor[1][std::size_t(e.j)][std::size_t(j)] * taylor[2][std::size_t(e.k)][std::size_t(k)];
      columns.row(Eigen::Index(m)) += t * gradient.row(Eigen::Index(n));
    }
  }
  return columns;
}

/// Completes the fit of one degree from the leading part of the Cholesky factor `lower` of the normal equations.
/// `traces` contains the contributions of the coefficients to the number of degrees of freedom.
inline std::optional<Local_fit_3> space_fit(const Space_system& system, const Eigen::MatrixXd& lower,
                                            const Eigen::VectorXd& reduced, const Eigen::VectorXd& traces,
                                            const Eigen::Vector3d& center, double radius, int degree,
                                            double normal_weight, const Number_request* request) {
  const Eigen::Index count = number_of_monomials_3(degree);
  const auto factor = lower.topLeftCorner(count, count).triangularView<Eigen::Lower>();
  const Eigen::VectorXd bombieri = factor.transpose().solve(reduced.head(count));
  const auto values = system.values.topRows(count), derivatives = system.derivatives.topRows(count);

  Local_fit_3 fit;
  fit.points = system.points;
  fit.patch = {
      Fit_family::SPACE, degree, radius, center, Eigen::Matrix3d::Identity(), 1, space_coefficients(bombieri, degree)};
  const auto foot = foot_of_center(fit.patch, fit.jet);
  if (!foot) return {};
  fit.curvatures = in_unit(curvatures_of(fit.jet), radius);
  fit.weight_of_normals = normal_weight;

  const double weight = system.roots_of_weights.squaredNorm();
  const double freedom = std::max(0.05, 1 - traces.head(count).sum() / double(system.points));
  const double residual = std::sqrt((values.transpose() * bombieri).squaredNorm() / (weight * freedom));
  fit.residual = residual * radius;
  const auto solved = [&](const Number_gradient& gradient) {
    Eigen::MatrixXd columns = space_gradient(gradient, *foot, std::size_t(count));
    factor.solveInPlace(columns);
    factor.transpose().solveInPlace(columns);
    return columns;
  };
  const Eigen::MatrixXd columns = solved(curvature_gradient(fit.jet));
  const Eigen::MatrixXd of_values = system.roots_of_weights.asDiagonal() * (values.transpose() * columns);
  const double slope = std::sqrt((derivatives.transpose() * bombieri - system.roots_of_weights).squaredNorm() / weight);
  const Eigen::MatrixXd of_normals =
      normal_weight * normal_weight * (system.roots_of_weights.asDiagonal() * (derivatives.transpose() * columns));
  const auto deviation = [&](Eigen::Index c) {
    return std::hypot(residual * of_values.col(c).norm(), slope * of_normals.col(c).norm()) / std::sqrt(system.part());
  };
  fit.deviations = in_unit({deviation(0), deviation(1), deviation(2)}, radius);
  if (request != nullptr) {
    const Jets_of_data jets(request->matrix / radius);
    fit.estimates =
        number_estimates(jets.numbers(fit.jet),
                         system.roots_of_weights.asDiagonal() * (values.transpose() * solved(jets.gradient(fit.jet))),
                         residual, system.noise, request->is_given, system.part());
  }
  return fit;
}

/// Returns whether points spread in two directions, by at least a hundredth, and not only along a curve.
inline bool spread_over_surface(const Data_points_3& data, std::span<const Data_points_3::Index> ball) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto i : ball) {
    const Eigen::Vector3d difference = data.points[i] - data.points[ball.front()];
    spread += difference * difference.transpose();
  }
  const Eigen::Vector3d squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvalues();
  return squares[1] > 1e-4 * squares[2];
}

/// Returns at most `most` of the points of a ball, evenly thinned.
inline std::vector<Data_points_3::Index> thinned(const std::vector<Data_points_3::Index>& ball, std::size_t most) {
  if (ball.size() <= most) return ball;
  std::vector<Data_points_3::Index> result(most);
  for (std::size_t k = 0; k < most; ++k) result[k] = ball[k * ball.size() / most];
  return result;
}

/// Fits polynomials in space of several degrees, at most `maximal_space_degree`, with several weights of the
/// conditions on normals, to the points of a connected ball. Degrees with fewer than 1.2 points per coefficient are
/// skipped. Residuals and the effect of noise are computed from some hundreds of the points. Computes estimates if
/// `request` is given.
inline std::vector<Local_fit_3> fit_spaces(const Data_points_3& data, Data_points_3::Index center, double radius,
                                           std::span<const int> degrees, std::span<const double> weights_of_normals,
                                           const Number_request* request = nullptr) {
  constexpr std::size_t most_rows = 500;
  constexpr double ridge = 1e-9;
  const auto ball = connected_ball(data, center, radius);
  const int greatest = greatest_degree(Fit_family::SPACE, degrees, ball.size());
  if (greatest == 0 || !spread_over_surface(data, ball)) return {};
  const Eigen::Vector3d& origin = data.points[center];
  const auto some = thinned(ball, most_rows);
  Space_system system = space_system(data, some, origin, radius, greatest);
  system.points = ball.size();
  if (request != nullptr) system.noise = noise_in_radii(request->noise, some, radius);
  const Monomial_moments moments = monomial_moments(data, ball, origin, radius, greatest);
  const Eigen::MatrixXd of_values = bombieri_basis_3.products(moments, greatest),
                        of_derivatives = bombieri_basis_3.products_of_derivatives(moments, greatest);
  const Eigen::VectorXd derivatives = bombieri_basis_3.derivatives(moments, greatest);

  std::vector<Local_fit_3> fits;
  for (const double weight : weights_of_normals) {
    Eigen::MatrixXd gram = of_values + weight * weight * of_derivatives;
    gram.diagonal().array() += ridge * of_values(0, 0);
    const Eigen::LLT<Eigen::MatrixXd> cholesky(gram);
    if (cholesky.info() != Eigen::Success) continue;
    const Eigen::MatrixXd lower = cholesky.matrixL();
    const Eigen::VectorXd reduced = cholesky.matrixL().solve(weight * weight * derivatives);
    Eigen::MatrixXd hat = of_values;
    cholesky.matrixL().solveInPlace(hat);
    hat.transposeInPlace();
    cholesky.matrixL().solveInPlace(hat);
    for (const int degree : degrees) {
      if (degree > greatest) continue;
      auto fit = space_fit(system, lower, reduced, hat.diagonal(), origin, radius, degree, weight, request);
      if (fit && std::isfinite(fit->deviations.euclidean)) fits.push_back(std::move(*fit));
    }
  }
  return fits;
}

} // namespace equiaffine::internal

#endif
