// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_STRUCTURES_OF_FIT_H
#define EQUIAFFINE_FIT_INTERNAL_STRUCTURES_OF_FIT_H

#include <equiaffine/base/named_parameters.h>
#include <equiaffine/base/parallel_for.h>
#include <equiaffine/fit/Fitted_structure_3.h>
#include <equiaffine/fit/internal/Patch_cover_3.h>
#include <equiaffine/fit/internal/Surface_fit_3.h>
#include <equiaffine/function/Level_set_traits_3.h>
#include <equiaffine/geometry/local_structure.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace equiaffine::internal {

/// Moves a point along gradients to the zero set of a patch, if that is near.
inline std::optional<Eigen::Vector3d> foot_on_patch(const Patch_3& patch, Eigen::Vector3d p) {
  for (int step = 0; step < 20; ++step) {
    const auto jet = patch.taylor<1>(p);
    const Eigen::Vector3d gradient(jet.coefficients()[1], jet.coefficients()[2], jet.coefficients()[3]);
    const Eigen::Vector3d newton = jet.value() * gradient / gradient.squaredNorm();
    if (!(newton.norm() < 0.25 * patch.radius)) return {};
    p -= newton;
    if (newton.norm() < 1e-12 * patch.radius) return p;
  }
  return {};
}

inline Fitted_structure_3<double> structure_without_fit() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  auto structure = local_structure(Jet_3<double>(nan));
  structure.status = Point_status::OUTSIDE;
  return {structure, {nan, nan}, {nan, nan}, nan, nan};
}

/// The errors of second derivatives that roundings make; infinity where K_e is zero within its estimated error, and no
/// more than that of a sphere whose radius is ten times that of the fit: an error may be large beside any curvature.
inline double rounding_of(const Jet_3<double>& jet, const Surface_fit_3& fit, const Fit_accuracy& accuracy) {
  const double curvature = std::abs(curvatures_of(jet).euclidean);
  const bool is_flat = curvature <= accuracy.euclidean_error && curvature * accuracy.radius * accuracy.radius <= 0.01;
  return is_flat ? std::numeric_limits<double>::infinity() : fit.rounding(fit.to_space(jet), accuracy.radius);
}

/// The structure of the level set through a point, from the expansion there of a fit, or of a blend of fits.
inline Fitted_structure_3<double> structure_of(const Jet_3<double>& jet, const Surface_fit_3& fit,
                                               const Fit_accuracy& accuracy, Orientation_of_level_set orientation) {
  Fitted_structure_3<double> result;
  const double sign = orientation == Orientation_of_level_set::AGAINST_GRADIENT ? -1 : 1;
  result.structure = local_structure(fit.to_space(jet) * sign, {0, 0, 0}, rounding_of(jet, fit, accuracy));
  const double size = result.structure.status == Point_status::REGULAR
                          ? curvatures_of(jet).size() * fit.normalization().matrix.determinant()
                          : std::numeric_limits<double>::quiet_NaN();
  result.error = {accuracy.error.gaussian * size, accuracy.error.mean * std::sqrt(size)};
  result.noise = {accuracy.noise.gaussian * size, accuracy.noise.mean * std::sqrt(size)};
  result.scale = accuracy.radius / fit.normalization().scale();
  result.deviation = accuracy.deviation / fit.normalization().scale();
  return result;
}

/// The distance of the centers of fits as a part of their radius: fits with small radii are made at every point.
constexpr double distance_of_direct_fits = 0.1;

/// The same at a given scale, where the curvatures of a point are those of the fit around it: on a scan, K of a fit
/// whose center is a tenth of the radius away differs from them by as much as noise makes.
constexpr double distance_of_direct_fits_at_scale = 0.02;

template <class ConcurrencyTag, class Parameters>
std::vector<Fitted_structure_3<double>> structures_of_fit(const Surface_fit_3& fit, const Parameters& parameters) {
  const auto orientation = get_parameter<Orientation_tag>(parameters, Orientation_of_level_set::ALONG_GRADIENT);
  const Data_points_3& data = fit.data();
  const double distance = fit.choices().has_scale() ? distance_of_direct_fits_at_scale : distance_of_direct_fits;
  const Patch_cover_3 cover = patch_cover(data, fit.choices(), distance, ConcurrencyTag());
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

} // namespace equiaffine::internal

#endif
