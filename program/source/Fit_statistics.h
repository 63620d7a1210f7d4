// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_PROGRAM_SOURCE_FIT_STATISTICS_H
#define EQUIAFFINE_PROGRAM_SOURCE_FIT_STATISTICS_H

#include "request/source_options.h"
#include "source/source_function.h"
#include <equiaffine/attributes/internal/error_table.h>
#include <equiaffine/fit/fitted_structures.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace equiaffine {

/// The facts about a fit, at the vertices of a mesh or at points, that the program reports.
struct Fit_statistics {
  using Parts = std::array<double, 3>;

  std::optional<double> scale;    ///< of the curvatures; nothing if they are the surface's own
  std::array<double, 3> scales{}; ///< the least, median and greatest scale or radius; NaN if there is no fit
  double noise = 0;               ///< the median of the deviations of the data; NaN if there is no fit
  /// The parts of the points whose error is below each of `error_bounds`, for each row of error_table.
  std::array<Parts, error_table<double>.size()> known{};

  /// The parts of the points that have no fit, that are parabolic, and those that have an error of K above the last
  /// bound: most of it from noise, or most of it from what the fits around disagree on.
  double without_fit = 0, parabolic = 0, doubtful_by_noise = 0, doubtful_by_detail = 0;

  const Parts& known_of(std::string_view attribute) const;
};

/// Bounds for an estimated error as a part of the size of its number.
inline constexpr std::array<double, 3> error_bounds = {0.1, 0.2, 0.5};

/// What people call a quantity, and at which parts of the points it is known.
struct Known_quantity {
  std::string_view label;
  Fit_statistics::Parts parts;
};

/// Returns the first one of K, H, J, affine normal and affine area density that is known to 50 % at half of the points,
/// or else K.
Known_quantity first_known(const Fit_statistics& fit);

/// "K 64 / 89, H 54 / 81, ...": at how many percent of the points each is known to 20 and to 50 %, and
/// of what these are parts.
std::string table_of_known(const Fit_statistics& fit);

Fit_statistics statistics_of(std::span<const Fitted_structure_3<double>> structures);

/// Sheets of the data of a fit that are nearer to each other than the steps of a grid, which does not tell them apart.
struct Close_sheets {
  std::size_t points = 0;     ///< the data that have another sheet so near
  double distance = 0;        ///< that a tenth of them are nearer than, in the unit of the data; NaN without points
  std::size_t resolution = 0; ///< of a grid that tells the others apart
};

/// For the grid on which Marching Cubes samples the fit.
Close_sheets close_sheets(const Fit_traits& fit, const Source_options& options);

} // namespace equiaffine

#endif
