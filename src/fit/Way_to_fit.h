// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_WAY_TO_FIT_H
#define EQUIAFFINE_SRC_FIT_WAY_TO_FIT_H

#include "fit/Local_fit_3.h"
#include "fit/fit_space.h"

#include <algorithm>
#include <cmath>

namespace equiaffine::internal {

/// A way to fit.
struct Way_to_fit {
  Fit_family family = Fit_family::HEIGHT;
  int degree = 4;
  double radius = 0; ///< as a multiple of the spacing of the points, or a length at a scale
  double weight_of_normals = 0;

  /// Whether it is this way in a ball that is smaller by enough to tell something else.
  bool is_smaller(const Way_to_fit& other) const {
    constexpr double ratio = 1.15;
    return family == other.family && degree == other.degree && weight_of_normals == other.weight_of_normals &&
           ratio * radius < other.radius;
  }

  /// The degree that the result is compared with.
  int other_degree() const { return degree + (family == Fit_family::HEIGHT ? 2 : 1); }

  /// Another degree to compare with. Where a ball in space holds most of a shape with a center of symmetry, odd degrees
  /// add nothing to even ones, which agree with them whatever they miss. The greatest degree has no such other.
  int other_degree_of_same_parity() const {
    return family == Fit_family::HEIGHT || degree + 2 <= maximal_space_degree ? degree + 2 : other_degree();
  }

  bool has_made(const Local_fit_3& fit, int of_degree) const {
    return fit.patch.family == family && fit.patch.degree == of_degree && fit.weight_of_normals == weight_of_normals;
  }
};

/// Returns the differences between the numbers of fits, relative to the sizes of the first one.
inline Number_errors relative_difference(const Fitted_numbers& fit, const Fitted_numbers& other) {
  return fit.differences(other) / fit.sizes();
}

/// The factor of standard deviations to which the part of the residual beyond the noise contributes as an error that
/// whole regions have in common.
inline double guard(const Local_fit_3& fit, double noise) {
  const double square = fit.residual * fit.residual;
  const double excess = square > 0 ? std::max(0., square - noise * noise) / square : 0;
  const double freedom = fit.patch.family == Fit_family::HEIGHT
                             ? double(number_of_coefficients(Fit_family::HEIGHT, fit.patch.degree))
                             : double((fit.patch.degree + 1) * (fit.patch.degree + 1));
  return std::sqrt(1 - excess + excess * std::max(1., double(fit.points) / freedom));
}

/// Returns relative errors with 1 for those of numbers that do not exist.
inline Number_errors errors_or_all(const Number_errors& relative) {
  return relative.unaryExpr([](double error) { return std::isfinite(error) ? error : 1; });
}

} // namespace equiaffine::internal

#endif
