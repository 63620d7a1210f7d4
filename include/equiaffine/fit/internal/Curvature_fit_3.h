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

/// A fit, or a mean of fits, is known to within these errors.
struct Fit_accuracy {
  Relative_errors error;  ///< the whole estimate, from the greatest difference to other fits and the standard deviation
  Relative_errors noise;  ///< two standard deviations of what noise alone makes
  double radius;          ///< of the ball whose points were fitted
  double deviation;       ///< of one point from any smooth surface
  double euclidean_error; ///< of K_e, within which it counts as zero
};

struct Curvature_fit_3 {
  Patch_3 patch;
  Fit_accuracy accuracy;
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
  Local_fit_3& fit = fits.front();
  const double size = fit.curvatures.size(), root = std::sqrt(size);
  const Local_fit_3& other = fits.back();
  const Relative_errors bias = greater_of_each(choice.level, relative_difference(fit.curvatures, other.curvatures));
  // Noise that is given counts as it is, whatever the residuals are.
  const double factor = choices.has_noise() && fit.residual > 0 ? choice.noise / fit.residual : 1;
  const Fitted_curvatures of_noise = scaled(fit.deviations, factor);
  const Fitted_curvatures guarded = guarded_deviations(fit, choice.noise);
  const Fitted_curvatures deviations = {std::max(guarded.gaussian, of_noise.gaussian),
                                        std::max(guarded.mean, of_noise.mean),
                                        std::max(guarded.euclidean, of_noise.euclidean)};
  Fit_accuracy accuracy;
  accuracy.error = {coverage * error_or_all(std::hypot(bias.gaussian, deviations.gaussian / size)),
                    coverage * error_or_all(std::hypot(bias.mean, deviations.mean / root))};
  accuracy.noise = {2 * error_or_all(of_noise.gaussian / size), 2 * error_or_all(of_noise.mean / root)};
  accuracy.euclidean_error = choices.has_scale() ? 0 : euclidean_error(fit, other, deviations);
  accuracy.radius = fit.patch.radius;
  accuracy.deviation = choice.noise;
  return Curvature_fit_3{std::move(fit.patch), accuracy};
}

} // namespace equiaffine::internal

#endif
