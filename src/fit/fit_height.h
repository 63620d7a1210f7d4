// SPDX-License-Identifier: GPL-3.0-or-later
// Fits heights above the tangent plane, as polynomials in two variables, to the points of a ball.
#ifndef EQUIAFFINE_SRC_FIT_FIT_HEIGHT_H
#define EQUIAFFINE_SRC_FIT_FIT_HEIGHT_H

#include "fit/Data_points_3.h"
#include "fit/Local_fit_3.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace equiaffine::internal {

constexpr int maximal_height_degree = 12;

/// Products of Legendre polynomials P_i(u) P_j(v) of total degree up to 12, ordered by degree, then by j.
class Legendre_basis_2 {
public:
  static constexpr std::size_t size = number_of_coefficients(Fit_family::HEIGHT, maximal_height_degree);
  using Line = std::array<double, maximal_height_degree + 1>;

  Legendre_basis_2() {
    for (auto& line : powers_) line.fill(0);
    powers_[0][0] = powers_[1][1] = 1;
    for (std::size_t n = 1; n + 1 < powers_.size(); ++n)
      for (std::size_t i = 0; i <= n + 1; ++i)
        powers_[n + 1][i] =
            ((2. * double(n) + 1) * (i > 0 ? powers_[n][i - 1] : 0) - double(n) * powers_[n - 1][i]) / (double(n) + 1);
    std::size_t m = 0;
    for (int degree = 0; degree <= maximal_height_degree; ++degree)
      for (int j = 0; j <= degree; ++j, ++m) exponents_[m] = {degree - j, j};
  }

  struct Exponents {
    int u, v;
  };
  const Exponents& exponents(std::size_t m) const { return exponents_[m]; }

  /// The coefficient of t^i in P_n(t).
  double power(int n, int i) const { return powers_[std::size_t(n)][std::size_t(i)]; }

  /// Writes the values at (u, v) of the products of degree up to `degree`.
  void evaluate(double u, double v, int degree, double* values) const {
    const Line p = line_at(u, degree), q = line_at(v, degree);
    const std::size_t count = number_of_coefficients(Fit_family::HEIGHT, degree);
    for (std::size_t m = 0; m < count; ++m)
      values[m] = p[std::size_t(exponents_[m].u)] * q[std::size_t(exponents_[m].v)];
  }

private:
  static Line line_at(double t, int degree) {
    Line p;
    p[0] = 1;
    p[1] = t;
    for (std::size_t n = 1; n < std::size_t(degree); ++n)
      p[n + 1] = ((2. * double(n) + 1) * t * p[n] - double(n) * p[n - 1]) / (double(n) + 1);
    return p;
  }

  std::array<Line, maximal_height_degree + 1> powers_;
  std::array<Exponents, size> exponents_;
};

inline const Legendre_basis_2 legendre_basis_2;

/// The rows sqrt(weight) (P_0(u) P_0(v), ...) and sqrt(weight) w of the points of a ball in a frame along the
/// normal.
struct Height_system {
  Eigen::Matrix3d frame;
  Eigen::MatrixXd rows; ///< a column per point
  Eigen::VectorXd heights, roots_of_weights;
  Eigen::VectorXd noise; ///< in radii; empty if unknown
  double least_cosine = 1;
};

inline Eigen::Matrix3d frame_along(const Eigen::Vector3d& normal) {
  Eigen::Matrix3d frame;
  frame.row(0) = normal.unitOrthogonal();
  frame.row(2) = normal;
  frame.row(1) = normal.cross(Eigen::Vector3d(frame.row(0)));
  return frame;
}

inline Height_system height_system(const Data_points_3& data, std::span<const Data_points_3::Index> ball, double radius,
                                   const Eigen::Vector3d& normal, int degree) {
  Height_system system;
  system.frame = frame_along(normal);
  system.rows.resize(Eigen::Index(number_of_coefficients(Fit_family::HEIGHT, degree)), Eigen::Index(ball.size()));
  system.heights.resize(Eigen::Index(ball.size()));
  system.roots_of_weights.resize(Eigen::Index(ball.size()));
  const Eigen::Vector3d& center = data.points[ball.front()];
  for (std::size_t k = 0; k < ball.size(); ++k) {
    const Eigen::Index column = Eigen::Index(k);
    const Eigen::Vector3d local = system.frame * (data.points[ball[k]] - center) / radius;
    const double root = std::sqrt(std::max(0., 1 - local.squaredNorm()));
    legendre_basis_2.evaluate(local[0], local[1], degree, system.rows.col(column).data());
    system.rows.col(column) *= root;
    system.heights[column] = root * local[2];
    system.roots_of_weights[column] = root;
    system.least_cosine = std::min(system.least_cosine, data.normals[ball[k]].dot(normal));
  }
  return system;
}

/// Converts coefficients of P_i(u) P_j(v) to those of u^i v^j, in the order of Patch_3.
inline std::vector<double> height_coefficients(const Eigen::VectorXd& legendre, int degree) {
  std::vector<double> coefficients(std::size_t(legendre.size()));
  const auto position = [degree](int i, int j) { return std::size_t(j * (degree + 1) - j * (j - 1) / 2 + i); };
  for (Eigen::Index m = 0; m < legendre.size(); ++m) {
    const auto [u, v] = legendre_basis_2.exponents(std::size_t(m));
    for (int i = u; i >= 0; i -= 2)
      for (int j = v; j >= 0; j -= 2)
        coefficients[position(i, j)] += legendre[m] * legendre_basis_2.power(u, i) * legendre_basis_2.power(v, j);
  }
  return coefficients;
}

/// The derivatives of numbers at the center with respect to the coefficients of the basis, one number per column.
inline Eigen::MatrixXd height_gradient(const Number_gradient& gradient, std::size_t count) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(Eigen::Index(count), gradient.cols());
  for (std::size_t m = 0; m < count; ++m) {
    const auto [u, v] = legendre_basis_2.exponents(m);
    for (int i = u % 2; i <= std::min(u, 4); i += 2)
      for (int j = v % 2; j <= std::min(v, 4 - i); j += 2) {
        const double power = legendre_basis_2.power(u, i) * legendre_basis_2.power(v, j);
        columns.row(Eigen::Index(m)) -= power * gradient.row(Jet_3<double>::index(i, j, 0));
      }
  }
  return columns;
}

/// Completes the fit of one degree from the leading part of the Cholesky factor `lower` of the normal equations.
/// `reduced` is the right-hand side after forward substitution.
inline Local_fit_3 height_fit(const Height_system& system, const Eigen::MatrixXd& lower, const Eigen::VectorXd& reduced,
                              const Eigen::Vector3d& center, double radius, int degree, const Number_request* request) {
  const auto count = Eigen::Index(number_of_coefficients(Fit_family::HEIGHT, degree));
  const auto factor = lower.topLeftCorner(count, count).triangularView<Eigen::Lower>();
  const auto rows = system.rows.topRows(count);
  Eigen::VectorXd legendre = factor.transpose().solve(reduced.head(count));
  // One step of iterative refinement, because the condition number of the normal equations is squared.
  Eigen::VectorXd correction = factor.solve(rows * (system.heights - rows.transpose() * legendre));
  legendre += factor.transpose().solve(correction);
  const Eigen::Index points = system.heights.size();

  Local_fit_3 fit;
  fit.points = std::size_t(points);
  fit.least_cosine = system.least_cosine;
  fit.patch = {Fit_family::HEIGHT, degree, radius, center, system.frame, 1, height_coefficients(legendre, degree)};
  const auto p = expand_height<4>(fit.patch, 0, 0);
  fit.patch.slope_factor = 1 / std::sqrt(1 + p[1][0] * p[1][0] + p[0][1] * p[0][1]);

  Jet_3<double> jet(0.);
  for (int i = 0; i <= 4; ++i)
    for (int j = 0; i + j <= 4; ++j)
      if (i + j > 0)
        jet.coefficients()[std::size_t(Jet_3<double>::index(i, j, 0))] = -p[std::size_t(i)][std::size_t(j)];
  jet.coefficients()[std::size_t(Jet_3<double>::index(0, 0, 1))] = 1;
  fit.jet = jet;
  fit.curvatures = in_unit(curvatures_of(jet), radius);

  const double weight = system.roots_of_weights.squaredNorm();
  const double squares = (system.heights - rows.transpose() * legendre).squaredNorm();
  const double residual = std::sqrt(squares / (weight * (1 - double(count) / double(points))));
  fit.residual = residual * radius;
  const auto influence = [&](const Number_gradient& gradient) -> Eigen::MatrixXd {
    Eigen::MatrixXd columns = height_gradient(gradient, std::size_t(count));
    factor.solveInPlace(columns);
    factor.transpose().solveInPlace(columns);
    return system.roots_of_weights.asDiagonal() * (rows.transpose() * columns);
  };
  const Eigen::VectorXd deviations = residual * influence(curvature_gradient(jet)).colwise().norm();
  fit.deviations = in_unit({deviations[0], deviations[1], deviations[2]}, radius);
  if (request != nullptr) {
    const Jets_of_data jets(system.frame * request->matrix / radius);
    fit.estimates = number_estimates(jets.numbers(jet), influence(jets.gradient(jet)), residual, system.noise,
                                     request->is_given, 1);
  }
  return fit;
}

/// Fits heights of several even degrees, at most `maximal_height_degree`, to the points of a connected ball. Degrees
/// with fewer than 1.2 points per coefficient are skipped. Computes estimates if `request` is given.
inline std::vector<Local_fit_3> fit_heights(const Data_points_3& data, Data_points_3::Index center, double radius,
                                            std::span<const int> degrees, const Number_request* request = nullptr) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = data.points[center];
  for (const auto i : connected_ball(data, center, radius))
    normal += data.normals[i] * (1 - (data.points[i] - origin).squaredNorm() / (radius * radius));
  normal.normalize();
  const auto ball =
      connected_ball(data, center, radius, [&](Data_points_3::Index i) { return data.normals[i].dot(normal) > 0.05; });

  const int greatest = greatest_degree(Fit_family::HEIGHT, degrees, ball.size());
  if (greatest == 0) return {};
  Height_system system = height_system(data, ball, radius, normal, greatest);
  if (request != nullptr) system.noise = noise_in_radii(request->noise, ball, radius);

  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(system.rows.rows(), system.rows.rows());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(system.rows);
  const Eigen::LLT<Eigen::MatrixXd> cholesky(gram);
  const Eigen::MatrixXd lower = cholesky.matrixL();
  const Eigen::VectorXd reduced = cholesky.matrixL().solve(system.rows * system.heights);

  std::vector<Local_fit_3> fits;
  for (const int degree : degrees) {
    const auto count = Eigen::Index(number_of_coefficients(Fit_family::HEIGHT, degree));
    if (degree > greatest) continue;
    const auto diagonal = lower.diagonal().head(count);
    if (!(diagonal.minCoeff() > 1e-6 * diagonal.maxCoeff())) continue;
    auto fit = height_fit(system, lower, reduced, origin, radius, degree, request);
    if (std::isfinite(fit.deviations.euclidean)) fits.push_back(std::move(fit));
  }
  return fits;
}

} // namespace equiaffine::internal

#endif
