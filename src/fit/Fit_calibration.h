// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_FIT_FIT_CALIBRATION_H
#define EQUIAFFINE_SRC_FIT_FIT_CALIBRATION_H

#include "fit/Fitted_numbers.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace equiaffine::internal {

/// The sources of errors of the numbers of a fit, each of which has its own factors.
enum class Source_of_error {
  DETAIL, ///< what polynomials leave out, since the data are exact
  BOTH,   ///< detail and noise below a fiftieth of the spacing of the points
  NOISE,  ///< detail and more noise
  SCALE   ///< noise alone, since the numbers are those at a scale
};

/// Data are exact where their noise is below this part of their spacing.
constexpr double noise_of_exact_data = 1e-4;

/// Returns the source of errors without a scale. `noise` is a part of the spacing of the points.
inline Source_of_error source_of_error(double noise) {
  constexpr double much_noise = 0.02;
  if (noise <= noise_of_exact_data) return Source_of_error::DETAIL;
  return noise < much_noise ? Source_of_error::BOTH : Source_of_error::NOISE;
}

/// The factors with which estimates of errors cover the errors at 95 % of the points where they are below a half, and at
/// 91.5 % on all meshes but one, up to a factor of 4. benchmark/fit/calibrate-fits makes them, from surfaces whose
/// numbers are known, with noise and without, and for a scale from halves of scans.
inline Number_errors calibration(Source_of_error source) {
  // of K, H, J, |K_e|^(1/4), K_e, H_e, k1, k2, the affine normal and the normal
  using Row = std::array<double, std::size_t(number_of_fitted_numbers)>;
  static constexpr std::array<Row, 4> rows = {{
      {2.1, 2.8, 3.0, 1.4, 0.9, 1.5, 1.4, 1.5, 2.6, 1.7}, // DETAIL
      {2.5, 2.2, 2.7, 1.9, 1.9, 1.8, 1.8, 2.1, 1.9, 2.1}, // BOTH
      {4.0, 2.4, 4.0, 4.0, 4.0, 3.8, 3.5, 3.5, 4.0, 4.0}, // NOISE
      {2.0, 2.3, 2.0, 2.2, 2.1, 2.0, 2.3, 2.1, 2.5, 2.5}, // SCALE
  }};
  return Eigen::Map<const Number_errors>(rows[std::size_t(source)].data());
}

} // namespace equiaffine::internal

#endif
