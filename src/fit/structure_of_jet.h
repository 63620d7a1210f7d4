// SPDX-License-Identifier: GPL-3.0-or-later
// The structure of a level set from an expansion of a fit, in the coordinates of the data, with its errors.
#ifndef EQUIAFFINE_SRC_FIT_STRUCTURE_OF_JET_H
#define EQUIAFFINE_SRC_FIT_STRUCTURE_OF_JET_H

#include "fit/Fitted_data_3.h"
#include "fit/Fitted_numbers.h"
#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/geometry/Local_structure_3.h>
#include <equiaffine/number/Jet_3.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace equiaffine::internal {

/// The errors of second derivatives that roundings make; infinity where K_e is zero within its estimated error, and no
/// more than that of a sphere whose radius is ten times that of the fit: an error may be large beside any curvature.
inline double rounding_of(const Jet_3<double>& jet, const Fitted_data_3& fit, const Fit_accuracy& accuracy) {
  const Fitted_numbers numbers(jet);
  const double curvature = std::abs(numbers.components[GAUSSIAN]);
  const bool is_flat = curvature <= accuracy.error[GAUSSIAN] * numbers.sizes()[GAUSSIAN] &&
                       curvature * accuracy.radius * accuracy.radius <= 0.01;
  return is_flat ? std::numeric_limits<double>::infinity() : fit.rounding(fit.to_space(jet), accuracy.radius);
}

/// The errors of the numbers of a structure that exist, from errors relative to their sizes. Angles are in degrees.
inline Local_structure_error_3<double> structure_error(const Number_errors& relative, const Number_errors& sizes,
                                                       Point_status status) {
  Number_errors e = relative * sizes;
  e.tail<2>() = (e.tail<2>() * (180 / std::numbers::pi)).min(180);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (status != Point_status::REGULAR) e[AFFINE_GAUSSIAN] = e[AFFINE_MEAN] = e[PICK] = e[AFFINE_NORMAL] = nan;
  if (status != Point_status::REGULAR && status != Point_status::PARABOLIC) e.setConstant(nan);
  return {{e[AFFINE_GAUSSIAN], e[AFFINE_MEAN]},
          e[PICK],
          e[AREA_DENSITY],
          e[AFFINE_NORMAL],
          e[NORMAL],
          e[GAUSSIAN],
          e[MEAN],
          e[K1],
          e[K2]};
}

inline Fitted_structure_3<double> structure_without_fit() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  auto structure = local_structure(Jet_3<double>(nan));
  structure.status = Point_status::OUTSIDE;
  const Local_structure_error_3<double> unknown =
      structure_error(Number_errors::Constant(nan), Number_errors::Ones(), structure.status);
  return {structure, unknown, unknown, unknown, nan, false, nan};
}

/// The structure of the level set through a point, from the expansion there of a fit, or of a blend of fits.
inline Fitted_structure_3<double> structure_of(const Jet_3<double>& jet, const Fitted_data_3& fit,
                                               const Fit_accuracy& accuracy, Orientation_of_level_set orientation) {
  Fitted_structure_3<double> result;
  const double sign = orientation == Orientation_of_level_set::AGAINST_GRADIENT ? -1 : 1;
  result.structure = local_structure(fit.to_space(jet) * sign, {0, 0, 0}, rounding_of(jet, fit, accuracy));
  const Number_errors sizes = Fitted_numbers(fit.to_space(jet)).sizes();
  result.error = structure_error(accuracy.error, sizes, result.structure.status);
  result.noise = structure_error(accuracy.noise, sizes, result.structure.status);
  result.detail = structure_error(accuracy.detail, sizes, result.structure.status);
  result.scale = fit.scale().value_or(accuracy.radius / fit.normalization().scale());
  result.is_at_scale = fit.scale().has_value();
  result.deviation = accuracy.deviation / fit.normalization().scale();
  return result;
}

} // namespace equiaffine::internal

#endif
