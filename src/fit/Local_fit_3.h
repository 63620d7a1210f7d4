// SPDX-License-Identifier: GPL-3.0-or-later
// One fitted polynomial with its expansions, its curvatures and their error estimates.
#ifndef EQUIAFFINE_SRC_FIT_LOCAL_FIT_3_H
#define EQUIAFFINE_SRC_FIT_LOCAL_FIT_3_H

#include "fit/Data_points_3.h"
#include "fit/Fitted_numbers.h"
#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/surface/internal/jet_derivatives.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace equiaffine::internal {

/// The kinds of polynomials fitted to points.
enum class Fit_family {
  HEIGHT, ///< w = p(u, v) in a frame whose third axis is a normal
  SPACE   ///< f(x, y, z) = 0
};

constexpr std::size_t number_of_coefficients(Fit_family family, int degree) {
  return std::size_t(family == Fit_family::HEIGHT ? (degree + 1) * (degree + 2) / 2
                                                  : (degree + 1) * (degree + 2) * (degree + 3) / 6);
}

/// Returns the highest degree with at least 1.2 points per coefficient, or 0.
inline int greatest_degree(Fit_family family, std::span<const int> degrees, std::size_t points) {
  int greatest = 0;
  for (const int degree : degrees)
    if (double(points) >= 1.2 * double(number_of_coefficients(family, degree))) greatest = std::max(greatest, degree);
  return greatest;
}

/// A polynomial whose zero set is the surface near a center, in units of `radius` around it. Its value approximates
/// the signed distance from the surface, in the unit of the points.
struct Patch_3 {
  using Vector = Eigen::Vector3d;

  Fit_family family = Fit_family::HEIGHT;
  int degree = 0;
  double radius = 1;
  Vector center = Vector::Zero();
  /// The axes of u, v, w as rows; the identity for Fit_family::SPACE.
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  double slope_factor = 1; ///< 1 / |gradient of w - p(u, v)| at the center
  /// Order for a height: u^i v^j with ascending i within ascending j. For a polynomial in space: x^i y^j z^k with
  /// ascending k within ascending j within ascending i.
  std::vector<double> coefficients;

  double value(const Vector& p) const;

  /// The expansion of order 1 or 4.
  template <int Order = default_order>
  Jet_3<double, Order> taylor(const Vector& p) const;
};

/// Replaces a polynomial c_0 + c_1 t + ... + c_n t^n by the first `count` coefficients of its expansion at t.
inline void expand_at(double t, double* c, int degree, int count) {
  for (int k = 0; k < count; ++k)
    for (int i = degree - 1; i >= k; --i) c[i] += t * c[i + 1];
}

/// Returns the coefficients of u^i v^j, i + j <= Order, of the expansion of p at (u, v); row i has those of u^i.
template <int Order>
auto expand_height(const Patch_3& patch, double u, double v) {
  constexpr std::size_t most = 13, orders = std::size_t(Order) + 1;
  std::array<std::array<double, most>, orders> rows = {}; // row i: coefficients of du^i as polynomials in v
  const double* c = patch.coefficients.data();
  for (int j = 0; j <= patch.degree; ++j) {
    const int degree = patch.degree - j, count = std::min(degree, Order) + 1;
    std::array<double, most> line;
    for (int i = 0; i <= degree; ++i) line[std::size_t(i)] = *c++;
    expand_at(u, line.data(), degree, count);
    for (int i = 0; i < count; ++i) rows[std::size_t(i)][std::size_t(j)] = line[std::size_t(i)];
  }
  std::array<std::array<double, orders>, orders> expansion = {};
  for (int i = 0; i <= Order; ++i) {
    const int count = Order - i + 1;
    expand_at(v, rows[std::size_t(i)].data(), patch.degree - i, count);
    for (int j = 0; j < count; ++j) expansion[std::size_t(i)][std::size_t(j)] = rows[std::size_t(i)][std::size_t(j)];
  }
  return expansion;
}

/// Returns the jet of w - p(u, v) in the coordinates of space, at a point in units of the radius.
template <int Order>
Jet_3<double, Order> height_taylor(const Patch_3& patch, const Eigen::Vector3d& local) {
  const auto p = expand_height<Order>(patch, local[0], local[1]);
  constexpr Monomial_set linear = all_monomials(1) & ~Monomial_set(1);
  const auto axis = [&](int row) {
    Jet_3<double, Order, linear> form;
    for (std::size_t n = 0; n < 3; ++n) form.coefficients()[n] = patch.frame(row, Eigen::Index(n));
    return form;
  };
  const auto u = axis(0), v = axis(1), w = axis(2);
  const auto one = w - u * p[1][0] - v * p[0][1] + (local[2] - p[0][0]);
  if constexpr (Order == 1) return one;
  else {
    const auto uu = square(u), uv = u * v, vv = square(v);
    const auto two = uu * p[2][0] + uv * p[1][1] + vv * p[0][2];
    const auto three = uu * (u * p[3][0] + v * p[2][1]) + vv * (u * p[1][2] + v * p[0][3]);
    const auto four = uu * (uu * p[4][0] + uv * p[3][1] + vv * p[2][2]) + vv * (uv * p[1][3] + vv * p[0][4]);
    return one - two - three - four;
  }
}

/// Returns the jet of a polynomial in space at a point in units of the radius.
template <int Order>
Jet_3<double, Order> space_taylor(const Patch_3& patch, const Eigen::Vector3d& local) {
  constexpr std::size_t most = 8, orders = std::size_t(Order) + 1;
  const int d = patch.degree;
  // planes[k][j]: coefficients of dy^j dz^k as polynomials in x
  std::array<std::array<std::array<double, most>, orders>, orders> planes;
  const double* c = patch.coefficients.data();
  for (int i = 0; i <= d; ++i) {
    std::array<std::array<double, most>, orders> rows = {}; // rows[k]: coefficients of x^i dz^k as polynomials in y
    for (int j = 0; i + j <= d; ++j) {
      const int degree = d - i - j, count = std::min(degree, Order) + 1;
      std::array<double, most> line{};
      for (int k = 0; k <= degree; ++k) line[std::size_t(k)] = *c++;
      expand_at(local[2], line.data(), degree, count);
      for (int k = 0; k < count; ++k) rows[std::size_t(k)][std::size_t(j)] = line[std::size_t(k)];
    }
    for (int k = 0; k <= std::min(d - i, Order); ++k) {
      const int count = std::min(d - i - k, Order - k) + 1;
      expand_at(local[1], rows[std::size_t(k)].data(), d - i - k, count);
      for (int j = 0; j < count; ++j)
        planes[std::size_t(k)][std::size_t(j)][std::size_t(i)] = rows[std::size_t(k)][std::size_t(j)];
    }
  }
  Jet_3<double, Order> jet(0.);
  for (int k = 0; k <= Order; ++k)
    for (int j = 0; j + k <= Order; ++j) {
      auto& line = planes[std::size_t(k)][std::size_t(j)];
      const int count = Order - j - k + 1;
      expand_at(local[0], line.data(), d - j - k, count);
      for (int i = 0; i < count; ++i)
        jet.coefficients()[std::size_t(Jet_3<double>::index(i, j, k))] = line[std::size_t(i)];
    }
  return jet;
}

template <int Order>
Jet_3<double, Order> Patch_3::taylor(const Vector& p) const {
  const Vector local = (family == Fit_family::HEIGHT ? Vector(frame * (p - center)) : Vector(p - center)) / radius;
  auto jet = family == Fit_family::HEIGHT ? height_taylor<Order>(*this, local) : space_taylor<Order>(*this, local);
  double scale = radius * slope_factor;
  std::size_t n = 0;
  for (int order = 0; order <= Order; ++order, scale /= radius)
    for (; n < std::size_t(number_of_monomials(order)); ++n) jet.coefficients()[n] *= scale;
  return jet;
}

inline double Patch_3::value(const Vector& p) const {
  const double* c = coefficients.data() + coefficients.size();
  if (family == Fit_family::HEIGHT) {
    const Vector local = frame * (p - center) / radius;
    double sum = 0;
    for (int j = degree; j >= 0; --j) {
      double line = 0;
      for (int i = degree - j; i >= 0; --i) line = line * local[0] + *--c;
      sum = sum * local[1] + line;
    }
    return (local[2] - sum) * radius * slope_factor;
  }
  const Vector local = (p - center) / radius;
  double sum = 0;
  for (int i = degree; i >= 0; --i) {
    double plane = 0;
    for (int j = degree - i; j >= 0; --j) {
      double line = 0;
      for (int k = degree - i - j; k >= 0; --k) line = line * local[2] + *--c;
      plane = plane * local[1] + line;
    }
    sum = sum * local[0] + plane;
  }
  return sum * radius * slope_factor;
}

struct Fitted_curvatures {
  double gaussian, mean; ///< affine curvatures
  double euclidean;      ///< Euclidean Gaussian curvature K_e

  /// The reference magnitude for errors of K. It does not vanish where K changes sign, nor on a paraboloid, where K
  /// and H are zero: the last term is a fraction of K of a sphere with that Gaussian curvature.
  double size() const { return std::abs(gaussian) + mean * mean + 0.01 * std::pow(std::abs(euclidean), 1.5); }
};

inline Fitted_curvatures curvatures_of(const Jet_3<double>& jet) {
  const Monge_chart_3<double> chart(jet);
  const auto invariants = affine_invariants(chart);
  const double slope = 1 + chart.a * chart.a + chart.b * chart.b;
  return {invariants.gaussian_curvature, invariants.mean_curvature, chart.d() / (slope * slope)};
}

/// Options for the estimates of the numbers and their errors.
struct Number_request {
  Eigen::Matrix3d matrix;        ///< from the data to the coordinates of the points
  std::span<const double> noise; ///< standard deviation of each point from a smooth surface; empty if unknown
  bool is_given = false;         ///< whether the user gave the noise: then it counts as it is, regardless of residuals
};

/// The numbers of the data at the foot of the center of a fit, with standard deviations.
struct Number_estimates {
  Fitted_numbers numbers;
  Number_errors of_residual; ///< if residuals are white noise
  Number_errors of_noise;    ///< from the noise of every point if it is known, or of the residual where that is smaller
};

/// A polynomial fitted to points, with the curvatures of its zero set at the foot of the center and their error
/// estimates.
struct Local_fit_3 {
  Patch_3 patch;
  Jet_3<double> jet = {}; ///< at the foot, in the frame of the patch and in radii
  Fitted_curvatures curvatures;
  Fitted_curvatures deviations = {}; ///< standard deviations if residuals are white noise
  double residual = 0;               ///< standard deviation of one point from the zero set
  std::size_t points = 0;            ///< in the ball
  double weight_of_normals = 0;      ///< of a polynomial in space
  double least_cosine = 1;           ///< of the angles between the third axis of the frame and the normals of the
                                     ///< points
  std::optional<Number_estimates> estimates = {}; ///< if requested
};

/// The derivatives of numbers, one per column, with respect to the coefficients of the jet.
using Number_gradient = Eigen::Matrix<double, int(Jet_3<double>::size), Eigen::Dynamic>;

/// The gradients of K, H and K_e, by central differences as in Jets_of_data.
inline Number_gradient curvature_gradient(const Jet_3<double>& jet) {
  Number_gradient gradient = Number_gradient::Zero(Eigen::Index(jet.size), 3);
  for (std::size_t n = 1; n < jet.size; ++n) {
    Jet_3<double> above = jet, below = jet;
    const double step = 1e-4 * std::max(0.01, std::abs(jet.coefficients()[n]));
    above.coefficients()[n] += step;
    below.coefficients()[n] -= step;
    const auto a = curvatures_of(above), b = curvatures_of(below);
    gradient.row(Eigen::Index(n)) << a.gaussian - b.gaussian, a.mean - b.mean, a.euclidean - b.euclidean;
    gradient.row(Eigen::Index(n)) /= 2 * step;
  }
  return gradient;
}

/// Curvatures for lengths in another unit, `unit` times as large.
inline Fitted_curvatures in_unit(const Fitted_curvatures& c, double unit) {
  const double volume = unit * unit * unit;
  return {c.gaussian / volume, c.mean / std::sqrt(volume), c.euclidean / (unit * unit)};
}

/// Estimates from the changes of the numbers if a point of the ball moves by a radius along its normal, a row of
/// `influence` for each point. `part` is the fraction of the points of the ball that have rows.
inline Number_estimates number_estimates(const Fitted_numbers& numbers, const Eigen::MatrixXd& influence,
                                         double residual, const Eigen::VectorXd& noise, bool is_given, double part) {
  Number_estimates result{numbers, {}, {}};
  const double factor = 1 / std::sqrt(part);
  result.of_residual = residual * factor * numbers.deviations(influence);
  result.of_noise = result.of_residual;
  if (noise.size() > 0) result.of_noise = factor * numbers.deviations(noise.asDiagonal() * influence);
  if (!is_given) result.of_noise = result.of_noise.min(result.of_residual).eval();
  return result;
}

/// The noise of points in radii of a ball; empty if unknown.
inline Eigen::VectorXd noise_in_radii(std::span<const double> noise, std::span<const Data_points_3::Index> ball,
                                      double radius) {
  Eigen::VectorXd result(noise.empty() ? 0 : Eigen::Index(ball.size()));
  for (Eigen::Index k = 0; k < result.size(); ++k) result[k] = noise[ball[std::size_t(k)]] / radius;
  return result;
}

/// The result of Newton steps along the gradient.
struct Foot_3 {
  Eigen::Vector3d point;    ///< on the zero set, to within the length of a further step
  Eigen::Vector3d before;   ///< the point from which the last step started
  Eigen::Vector3d gradient; ///< of the function at `before`
};

/// Moves a point along gradients to the zero set of a function with the jets `jet_at(p)`, until a step is at most
/// `least_step` long. Returns nothing if a step reaches `greatest_step(p)`, or after `most_steps`.
template <class Jet_at, class Greatest_step>
std::optional<Foot_3> foot_on_surface(Eigen::Vector3d p, const Jet_at& jet_at, const Greatest_step& greatest_step,
                                      double least_step, int most_steps) {
  for (int n = 0; n < most_steps; ++n) {
    const auto jet = jet_at(p);
    const Eigen::Vector3d gradient = eigen_gradient(jet);
    const Eigen::Vector3d step = jet.value() * gradient / gradient.squaredNorm();
    const double length = step.norm();
    if (!(length < greatest_step(p))) return {};
    if (length <= least_step) return Foot_3{p - step, p, gradient};
    p -= step;
  }
  return {};
}

} // namespace equiaffine::internal

#endif
