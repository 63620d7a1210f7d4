// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_FIT_CANDIDATE_H
#define EQUIAFFINE_FIT_INTERNAL_FIT_CANDIDATE_H

#include <equiaffine/fit/internal/Local_fit_3.h>
#include <equiaffine/fit/internal/fit_space.h>

#include <algorithm>
#include <cmath>

namespace equiaffine::internal {

/// A way to fit.
struct Fit_candidate {
  Fit_family family = Fit_family::HEIGHT;
  int degree = 4;
  double radius = 0; ///< as a multiple of the spacing of the points, or a length if the scale is given
  double weight_of_normals = 0;

  /// The degree that the result is compared with.
  int other_degree() const { return degree + (family == Fit_family::HEIGHT ? 2 : 1); }

  /// Another degree to compare with. Where a ball in space holds most of a shape with a center of symmetry, odd degrees
  /// add nothing to even ones, which agree with them whatever they miss. The greatest degree has no such other.
  int other_degree_of_same_parity() const {
    return family == Fit_family::HEIGHT || degree + 2 <= maximal_space_degree ? degree + 2 : other_degree();
  }

  bool made(const Local_fit_3& fit, int of_degree) const {
    return fit.patch.family == family && fit.patch.degree == of_degree && fit.weight_of_normals == weight_of_normals;
  }
};

/// Errors relative to |K| + H^2 and to its root.
struct Relative_errors {
  double gaussian, mean;
};

/// The factor of the root mean square error with which an estimate covers the error at 19 of 20 points, measured on
/// surfaces whose curvatures are known, with noise and without.
constexpr double coverage = 2.2;

/// Returns the differences between the curvatures of fits, relative to those of the first one.
inline Relative_errors relative_difference(const Fitted_curvatures& fit, const Fitted_curvatures& other) {
  return {std::abs(other.gaussian - fit.gaussian) / fit.size(),
          std::abs(other.mean - fit.mean) / std::sqrt(fit.size())};
}

inline Relative_errors greater_of_each(const Relative_errors& a, const Relative_errors& b) {
  return {std::max(a.gaussian, b.gaussian), std::max(a.mean, b.mean)};
}

inline Fitted_curvatures scaled(const Fitted_curvatures& c, double factor) {
  return {factor * c.gaussian, factor * c.mean, factor * c.euclidean};
}

/// Returns the standard deviations of curvatures, to which the part of the residual beyond the noise contributes as an
/// error that whole regions have in common.
inline Fitted_curvatures guarded_deviations(const Local_fit_3& fit, double noise) {
  const double square = fit.residual * fit.residual;
  const double excess = square > 0 ? std::max(0., square - noise * noise) / square : 0;
  const double freedom = fit.patch.family == Fit_family::HEIGHT
                             ? double(number_of_coefficients(Fit_family::HEIGHT, fit.patch.degree))
                             : double((fit.patch.degree + 1) * (fit.patch.degree + 1));
  return scaled(fit.deviations, std::sqrt(1 - excess + excess * std::max(1., double(fit.points) / freedom)));
}

/// Returns the estimated error of K_e, from the difference to another fit and the standard deviation.
inline double euclidean_error(const Local_fit_3& fit, const Local_fit_3& other, const Fitted_curvatures& deviations) {
  return coverage * std::hypot(fit.curvatures.euclidean - other.curvatures.euclidean, deviations.euclidean);
}

/// Returns a relative error, or 1 for that of a curvature that does not exist.
inline double error_or_all(double relative) { return std::isfinite(relative) ? relative : 1; }

} // namespace equiaffine::internal

#endif
