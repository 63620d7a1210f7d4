// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_FIT_INTERNAL_CURVATURE_FIT_3_H
#define EQUIAFFINE_FIT_INTERNAL_CURVATURE_FIT_3_H

#include <equiaffine/fit/internal/Fit_choice_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The factor of the root mean square error with which an estimate covers the error at 19 of 20 points, measured on
/// surfaces whose curvatures are known, with noise and without.
constexpr double coverage = 2.2;

/// A fit around a point with estimates of its errors, from the greatest difference to other fits and the standard
/// deviation, and two standard deviations of what noise alone makes.
struct Curvature_fit_3 {
  Patch_3 patch;
  Relative_errors error, noise;
};

/// Fits polynomials of the degree of a candidate and of the one it is compared with, in this order. Where the ball has
/// too few points, as at a border of the surface, it grows.
inline std::vector<Local_fit_3> fit_candidate(const Data_points_3& data, Data_points_3::Index center, double radius,
                                              const Fit_candidate& candidate) {
  const std::array<int, 2> degrees = {candidate.degree, candidate.other_degree()};
  const std::array<double, 1> weights = {candidate.weight_of_normals};
  std::vector<Local_fit_3> fits;
  for (int attempt = 0; attempt < 6 && fits.size() < degrees.size(); ++attempt, radius *= 1.15)
    fits = candidate.family == Fit_family::HEIGHT ? fit_heights(data, center, radius, degrees)
                                                  : fit_spaces(data, center, radius, degrees, weights);
  return fits;
}

inline std::optional<Curvature_fit_3> curvature_fit(const Data_points_3& data, Data_points_3::Index center,
                                                    const Fit_choice_3::Choice& choice, const Fit_choice_3& choices) {
  auto fits = fit_candidate(data, center, choices.radius(choice.candidate, center), choice.candidate);
  if (fits.empty() || !choice.candidate.made(fits[0], choice.candidate.degree)) return {};
  Local_fit_3& fit = fits[0];
  const double size = fit.curvatures.size();
  double gaussian = choice.level.gaussian * size, mean = choice.level.mean * std::sqrt(size);
  const auto compare_with = [&](const Local_fit_3& other) {
    gaussian = std::max(gaussian, std::abs(other.curvatures.gaussian - fit.curvatures.gaussian));
    mean = std::max(mean, std::abs(other.curvatures.mean - fit.curvatures.mean));
  };
  if (fits.size() > 1) compare_with(fits[1]);
  const Affine_curvatures deviation = {guarded_deviation(fit, fit.deviation.gaussian, choice.noise),
                                       guarded_deviation(fit, fit.deviation.mean, choice.noise)};
  Curvature_fit_3 result;
  result.error = {coverage * std::hypot(gaussian, deviation.gaussian) / size,
                  coverage * std::hypot(mean, deviation.mean) / std::sqrt(size)};
  result.noise = {2 * fit.deviation.gaussian / size, 2 * fit.deviation.mean / std::sqrt(size)};
  result.patch = std::move(fit.patch);
  return result;
}

} // namespace equiaffine::internal

#endif
