// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_STRUCTURES_OF_FIT_H
#define EQUIAFFINE_FIT_INTERNAL_STRUCTURES_OF_FIT_H

#include <equiaffine/Level_set_traits_3.h>
#include <equiaffine/Local_structure_3.h>
#include <equiaffine/base/internal/shared/check_argument.h>
#include <equiaffine/base/internal/shared/parallel_for.h>
#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/fit/internal/Fitted_data_3.h>
#include <equiaffine/fit/internal/blend/Patch_cover_3.h>
#include <equiaffine/fit/internal/data/fit_input.h>
#include <equiaffine/fit/internal/declared_fits.h>
#include <equiaffine/fit/internal/shared/Extent_of_fit.h>
#include <equiaffine/surface/internal/shared/foot_on_surface.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Moves a point along gradients to the zero set of a patch, if that is near.
inline std::optional<Eigen::Vector3d> foot_on_patch(const Patch_3& patch, const Eigen::Vector3d& p) {
  const auto foot = foot_on_surface(
      p, [&](const Eigen::Vector3d& q) { return patch.taylor<1>(q); },
      [&](const Eigen::Vector3d&) { return 0.25 * patch.radius; }, 1e-12 * patch.radius, 20);
  return foot ? std::optional(foot->point) : std::nullopt;
}

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

/// The distance of the centers of fits as a part of their radius: fits with small radii are made at every point.
constexpr double distance_of_direct_fits = 0.1;

/// The same at a given scale, where the curvatures of a point are those of the fit around it: on a scan, K of a fit
/// whose center is a tenth of the radius away differs from them by as much as noise makes.
constexpr double distance_of_direct_fits_at_scale = 0.02;

/// Refuses data in units in which affine curvatures, and what they are computed from, leave double precision.
inline void check_extent(const Fitted_data_3& fit) {
  check_argument(Extent_of_fit::has(fit.diagonal()),
                 "the points lie in a box with a diagonal below 1e-40 or beyond 1e40: choose another unit");
}

/// The structure at a data point by the fit around it.
inline Fitted_structure_3<double> structure_at_point(const Fitted_data_3& fit, Data_points_3::Index i,
                                                     Orientation_of_level_set orientation) {
  check_extent(fit);
  const Data_points_3& data = fit.data();
  const auto& choice = fit.choices().at(data.points[i]);
  const auto curvature = choice ? curvature_fit(data, i, *choice, fit.choices(), Fit_use::NUMBERS) : std::nullopt;
  const auto foot = curvature ? foot_on_patch(curvature->patch, data.points[i]) : std::nullopt;
  if (!foot) return structure_without_fit();
  return structure_of(curvature->patch.taylor(*foot), fit, curvature->accuracy, orientation);
}

template <class ConcurrencyTag>
std::vector<Fitted_structure_3<double>> structures_of_fit(const Fitted_data_3& fit,
                                                          Orientation_of_level_set orientation) {
  check_extent(fit);
  const Data_points_3& data = fit.data();
  const double distance = fit.choices().scale() ? distance_of_direct_fits_at_scale : distance_of_direct_fits;
  const Patch_cover_3 cover = patch_cover(data, fit.choices(), Fit_use::NUMBERS, distance, ConcurrencyTag());
  std::vector<Fitted_structure_3<double>> structures(data.size(), structure_without_fit());
  parallel_for<ConcurrencyTag>(
      0, data.size(),
      [&](std::size_t i) {
        const auto k = cover.nearest[i];
        if (k == Patch_cover_3::none || !cover.fits[k]) return;
        const Patch_3& patch = cover.fits[k]->patch;
        if (const auto foot = foot_on_patch(patch, data.points[i]))
          structures[i] = structure_of(patch.taylor(*foot), fit, cover.fits[k]->accuracy, orientation);
      },
      64);
  return structures;
}

template <class ConcurrencyTag>
std::vector<Fitted_structure_3<double>> structures_of_data(Fit_data_3 given, const Fit_request& request,
                                                           Orientation_of_level_set orientation) {
  const std::size_t count = given.points.size();
  const bool is_mesh = given.kind == Fit_data_3::Kind::MESH;
  Fit_input_3 input = fit_input<ConcurrencyTag>(std::move(given));
  const Fitted_data_3 fit(std::move(input.data), request, ConcurrencyTag());
  auto structures = structures_of_fit<ConcurrencyTag>(fit, orientation);
  if (!is_mesh) return elements_at(structures, input.positions);
  structures.resize(count); // without points of creases
  return structures;
}

template <class ConcurrencyTag>
Fitted_structure_3<double> structure_of_vertex(Fit_data_3 given, const Fit_request& request,
                                               Orientation_of_level_set orientation, std::size_t i) {
  const Fitted_data_3 fit(fit_input<ConcurrencyTag>(std::move(given)).data, request, ConcurrencyTag());
  return structure_at_point(fit, Data_points_3::Index(i), orientation);
}

} // namespace equiaffine::internal

#endif
