// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_LOCAL_FIT_3_H
#define EQUIAFFINE_FIT_INTERNAL_LOCAL_FIT_3_H

#include <equiaffine/fit/internal/Patch_3.h>
#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/number/Jet_3.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace equiaffine::internal {

struct Fitted_curvatures {
  double gaussian, mean; ///< the affine ones
  double euclidean;      ///< the Euclidean Gaussian curvature K_e

  /// The size that errors of K are compared with. It is not zero where K changes its sign, nor on a paraboloid, where K
  /// and H are zero: the last term is a part of K of a sphere with that Gaussian curvature.
  double size() const { return std::abs(gaussian) + mean * mean + 0.01 * std::pow(std::abs(euclidean), 1.5); }
};

inline Fitted_curvatures curvatures_of(const Jet_3<double>& jet) {
  const Monge_chart_3<double> chart(jet);
  const auto invariants = affine_invariants(chart);
  const double slope = 1 + chart.a * chart.a + chart.b * chart.b;
  return {invariants.gaussian_curvature, invariants.mean_curvature, chart.d() / (slope * slope)};
}

/// A polynomial fitted to points, with the curvatures of its zero set at the foot of the center and what is known about
/// their errors.
struct Local_fit_3 {
  Patch_3 patch;
  Fitted_curvatures curvatures;
  Fitted_curvatures deviations = {}; ///< standard deviations if residuals are white noise
  double residual = 0;               ///< the standard deviation of one point from the zero set
  std::size_t points = 0;            ///< in the ball
  double weight_of_normals = 0;      ///< of a polynomial in space
  double least_cosine = 1;           ///< of the angles between the frame's third axis and the normals of the points
};

/// How K, H and K_e, in this order in the columns, change with the coefficients of the jet.
using Curvature_gradient = Eigen::Matrix<double, int(Jet_3<double>::size), 3>;

/// Central differences whose step is 1e-4 of a coefficient: the curvatures are smooth functions of the coefficients,
/// and a standard deviation needs few digits.
inline Curvature_gradient curvature_gradient(const Jet_3<double>& jet) {
  Curvature_gradient gradient = Curvature_gradient::Zero();
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

} // namespace equiaffine::internal

#endif
