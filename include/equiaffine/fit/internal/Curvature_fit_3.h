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

/// What is known of the errors of a fit: estimates of the whole errors, two standard deviations of what noise alone
/// makes, the radius of the ball whose points were fitted, and the deviation of one point from any smooth surface.
struct Fit_accuracy {
  Relative_errors error, noise;
  double radius, deviation;
};

/// A fit around a point with estimates of its errors, from the greatest difference to other fits and the standard
/// deviation, and two standard deviations of what noise alone makes.
struct Curvature_fit_3 {
  Patch_3 patch;
  Relative_errors error, noise;
  double deviation; ///< of one point from any smooth surface

  Fit_accuracy accuracy() const { return {error, noise, patch.radius, deviation}; }
};

/// Fits polynomials of the degree of a candidate and of the one it is compared with, in this order. Where the ball has
/// too few points for both, as at a border of the surface, it grows. Where they do not determine a polynomial, since
/// they fill a small part of the ball only, it shrinks.
inline std::vector<Local_fit_3> fit_candidate(const Data_points_3& data, Data_points_3::Index center, double radius,
                                              const Fit_candidate& candidate) {
  const std::array<int, 2> degrees = {candidate.degree, candidate.other_degree()};
  const std::array<double, 1> weights = {candidate.weight_of_normals};
  const auto fit = [&](double r) {
    auto fits = candidate.family == Fit_family::HEIGHT ? fit_heights(data, center, r, degrees)
                                                       : fit_spaces(data, center, r, degrees, weights);
    if (!fits.empty() && !candidate.made(fits.front(), candidate.degree)) fits.clear();
    return fits;
  };
  std::vector<Local_fit_3> fits = fit(radius);
  for (int step = 1; step < 6 && fits.size() < degrees.size(); ++step)
    if (auto larger = fit(radius * std::pow(1.15, step)); larger.size() > fits.size()) fits = std::move(larger);
  for (int step = 1; step < 6 && fits.empty(); ++step) fits = fit(radius / std::pow(1.3, step));
  return fits;
}

inline std::optional<Curvature_fit_3> curvature_fit(const Data_points_3& data, Data_points_3::Index center,
                                                    const Fit_choice_3::Choice& choice, const Fit_choice_3& choices) {
  auto fits = fit_candidate(data, center, choices.radius(choice.candidate, center), choice.candidate);
  if (fits.empty()) return {};
  Local_fit_3& fit = fits[0];
  const double size = fit.curvatures.size();
  double gaussian = choice.level.gaussian * size, mean = choice.level.mean * std::sqrt(size);
  const auto compare_with = [&](const Local_fit_3& other) {
    gaussian = std::max(gaussian, std::abs(other.curvatures.gaussian - fit.curvatures.gaussian));
    mean = std::max(mean, std::abs(other.curvatures.mean - fit.curvatures.mean));
  };
  if (fits.size() > 1) compare_with(fits[1]);
  const double gaussian_deviation = guarded_deviation(fit, fit.gaussian_deviation, choice.noise),
               mean_deviation = guarded_deviation(fit, fit.mean_deviation, choice.noise);
  Curvature_fit_3 result;
  result.error = {coverage * std::hypot(gaussian, gaussian_deviation) / size,
                  coverage * std::hypot(mean, mean_deviation) / std::sqrt(size)};
  result.noise = {2 * fit.gaussian_deviation / size, 2 * fit.mean_deviation / std::sqrt(size)};
  result.deviation = choice.noise;
  result.patch = std::move(fit.patch);
  return result;
}

} // namespace equiaffine::internal

#endif
