// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_LOCAL_FIT_3_H
#define EQUIAFFINE_FIT_INTERNAL_LOCAL_FIT_3_H

#include <equiaffine/fit/internal/Patch_3.h>
#include <equiaffine/geometry/affine_structure.h>
#include <equiaffine/number/Jet_3.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace equiaffine::internal {

struct Affine_curvatures {
  double gaussian, mean;
  double typical; ///< |K_e|^(3/2), which is K of a sphere with that Gaussian curvature

  /// The size that errors of K are compared with. It is not zero where K changes its sign, nor on a paraboloid, where K
  /// and H are zero.
  double size() const { return std::abs(gaussian) + mean * mean + 0.01 * typical; }
};

inline Affine_curvatures curvatures_of(const Jet_3<double>& jet) {
  const Monge_chart_3<double> chart(jet);
  const auto invariants = affine_invariants(chart);
  const double slope = 1 + chart.a * chart.a + chart.b * chart.b;
  return {invariants.gaussian_curvature, invariants.mean_curvature,
          std::pow(std::abs(chart.d()) / (slope * slope), 1.5)};
}

/// A polynomial fitted to points, with the curvatures of its zero set at the foot of the center and what is known about
/// their errors.
struct Local_fit_3 {
  Patch_3 patch;
  Affine_curvatures curvatures;
  double gaussian_deviation = 0, mean_deviation = 0; ///< standard deviations if residuals are white noise
  double residual = 0;                               ///< the standard deviation of one point from the zero set
  std::size_t points = 0;                            ///< in the ball
  double weight_of_normals = 0;                      ///< of a polynomial in space
  double least_cosine = 1; ///< of the angles between the frame's third axis and the normals of the points
};

/// How the curvatures change with the coefficients of the jet.
struct Curvature_gradient {
  std::array<double, Jet_3<double>::size> gaussian, mean;
};

/// Central differences whose step is 1e-4 of a coefficient: the curvatures are smooth functions of the coefficients,
/// and a standard deviation needs few digits.
inline Curvature_gradient curvature_gradient(const Jet_3<double>& jet) {
  Curvature_gradient gradient = {};
  for (std::size_t n = 1; n < jet.size; ++n) {
    Jet_3<double> above = jet, below = jet;
    const double step = 1e-4 * std::max(0.01, std::abs(jet.coefficients()[n]));
    above.coefficients()[n] += step;
    below.coefficients()[n] -= step;
    const auto a = curvatures_of(above), b = curvatures_of(below);
    gradient.gaussian[n] = (a.gaussian - b.gaussian) / (2 * step);
    gradient.mean[n] = (a.mean - b.mean) / (2 * step);
  }
  return gradient;
}

/// Curvatures for lengths in another unit, `unit` times as large.
inline Affine_curvatures in_unit(const Affine_curvatures& c, double unit) {
  const double volume = unit * unit * unit;
  return {c.gaussian / volume, c.mean / std::sqrt(volume), c.typical / volume};
}

} // namespace equiaffine::internal

#endif
