// SPDX-License-Identifier: GPL-3.0-or-later
// Fits polynomials around one point, and estimates the errors of their curvatures.
#ifndef EQUIAFFINE_SRC_FIT_CURVATURE_FIT_3_H
#define EQUIAFFINE_SRC_FIT_CURVATURE_FIT_3_H

#include "fit/Fit_choices_3.h"
#include "fit/Fitted_numbers.h"
#include <equiaffine/base/internal/index_sets.h>
#include <equiaffine/base/internal/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The accuracy of a fit, or of a mean of fits. Errors are relative to the sizes of the numbers.
struct Fit_accuracy {
  Number_errors error;  ///< estimated total error of the quantity that the fit stands for
  Number_errors noise;  ///< two standard deviations due to noise alone
  Number_errors detail; ///< at a scale: effect of residuals larger than noise; else the error
  double radius;        ///< of the fitted ball
  double deviation;     ///< of one point from any smooth surface
};

struct Curvature_fit_3 {
  Patch_3 patch;
  Fitted_numbers numbers; ///< at the foot of the center
  Fit_accuracy accuracy;
};

/// Fits polynomials of several degrees of a family. The ball grows where it has too few points for all degrees, as
/// at a border of the surface. It shrinks where its points do not determine a polynomial because they fill only a
/// small part of it.
inline std::vector<Local_fit_3> fit_in_way(const Data_points_3& data, Data_points_3::Index center, double radius,
                                           const Way_to_fit& way, std::span<const int> degrees,
                                           const Number_request& request) {
  const std::array<double, 1> weights = {way.weight_of_normals};
  const auto fit = [&](double r) {
    auto fits = way.family == Fit_family::HEIGHT ? fit_heights(data, center, r, degrees, &request)
                                                 : fit_spaces(data, center, r, degrees, weights, &request);
    if (!fits.empty() && !way.has_made(fits.front(), way.degree)) fits.clear();
    return fits;
  };
  std::vector<Local_fit_3> fits = fit(radius);
  for (int step = 1; step < 6 && fits.size() < degrees.size(); ++step)
    if (auto larger = fit(radius * std::pow(1.15, step)); larger.size() > fits.size()) fits = std::move(larger);
  for (int step = 1; step < 6 && fits.empty(); ++step) fits = fit(radius / std::pow(1.3, step));
  return fits;
}

/// The error of K is the typical difference between degrees around the point to this power, times the difference at
/// the point to the complementary power, but at least the latter, which is small by chance at some points.
constexpr double power_of_level = 0.88;

/// The accuracy of the higher of two degrees on exact data. A ball smaller by 1.35, whose error is about five times
/// smaller, gives the error of this one, unless both agree by chance. Residuals are approximation errors rather than
/// noise, and count in part.
inline Fit_accuracy exact_accuracy(const Local_fit_3& fit, const Local_fit_3& lower, const Local_fit_3& smaller,
                                   double noise) {
  constexpr double part_of_difference = 0.12, part_of_residual = 0.75;
  const Number_estimates& estimates = *fit.estimates;
  const Number_errors sizes = estimates.numbers.sizes();
  const Number_errors to_lower = relative_difference(estimates.numbers, lower.estimates->numbers);
  Number_errors bias =
      relative_difference(estimates.numbers, smaller.estimates->numbers).max(part_of_difference * to_lower);
  bias[GAUSSIAN] = std::max(bias[GAUSSIAN], to_lower[GAUSSIAN]); // within which K_e counts as zero
  const Number_errors deviations = estimates.of_residual / sizes;
  Fit_accuracy accuracy;
  accuracy.error = calibration(Source_of_error::DETAIL) *
                   errors_or_all((bias.square() + (part_of_residual * deviations).square()).sqrt());
  accuracy.noise = 2 * std::min(1., noise / fit.residual) * errors_or_all(deviations);
  accuracy.detail = accuracy.error;
  accuracy.deviation = noise;
  return accuracy;
}

/// The accuracy of the curvatures of the surface itself, from the difference to another degree and the standard
/// deviation. `spacing` is that of the points. `growth` is the ratio of the radius to the chosen one, larger at
/// borders, where differences between degrees are less reliable.
inline Fit_accuracy own_accuracy(const Local_fit_3& fit, const Local_fit_3& other, const Fit_choice& choice,
                                 bool has_noise, double spacing, double growth) {
  const Number_estimates& estimates = *fit.estimates;
  const Number_errors sizes = estimates.numbers.sizes();
  const Number_errors difference = relative_difference(estimates.numbers, other.estimates->numbers);
  Number_errors bias = (std::pow(std::max(1., growth), 4) * choice.level).max(difference);
  double& of_gaussian = bias[AFFINE_GAUSSIAN];
  const double here = difference[AFFINE_GAUSSIAN];
  const bool has_other = &other != &fit; // a ball at a border may have points for one degree only
  if (has_other)
    of_gaussian = std::max(here, std::pow(of_gaussian, power_of_level) * std::pow(here, 1 - power_of_level));
  // Noise given by the user counts as it is, regardless of the residuals.
  const double factor = has_noise && fit.residual > 0 ? choice.noise / fit.residual : 1;
  const Number_errors deviations = std::max(guard(fit, choice.noise), factor) * estimates.of_residual / sizes;
  Fit_accuracy accuracy;
  accuracy.error = calibration(source_of_error(choice.noise / spacing)) *
                   errors_or_all((bias.square() + deviations.square()).sqrt());
  accuracy.noise = 2 * errors_or_all(factor * estimates.of_residual / sizes);
  accuracy.detail = accuracy.error;
  accuracy.deviation = choice.noise;
  return accuracy;
}

/// The accuracy of curvatures at a scale, where only noise and sampling cause errors.
inline Fit_accuracy accuracy_at_scale(const Local_fit_3& fit, double noise) {
  const Number_estimates& estimates = *fit.estimates;
  const Number_errors sizes = estimates.numbers.sizes();
  Fit_accuracy accuracy;
  accuracy.error = calibration(Source_of_error::SCALE) * errors_or_all(estimates.of_noise / sizes);
  accuracy.noise = accuracy.error;
  accuracy.detail = 2 * guard(fit, noise) * errors_or_all(estimates.of_residual / sizes);
  accuracy.deviation = noise;
  return accuracy;
}

/// Returns the difference to the next degree, relative to the sizes of the numbers, where the data are nearly exact;
/// noise would explain it elsewhere. It measures what a scale mixes, for example the jump of the curvature at a
/// smooth joint of a sphere and a cylinder.
inline Number_errors mixture_at_scale(const Data_points_3& data, Data_points_3::Index center, const Way_to_fit& way,
                                      const Local_fit_3& fit, const Number_request& request) {
  constexpr double nearly_exact = 0.01, quiet_part = 0.25; // relative to the spacing, and to the number of points of
                                                           // the ball
  std::vector<double> noise;
  for (const auto i : connected_ball(data, center, fit.patch.radius)) noise.push_back(request.noise[i]);
  const auto quiet = noise.begin() + std::ptrdiff_t(quiet_part * double(noise.size()));
  std::nth_element(noise.begin(), quiet, noise.end());
  if (*quiet > nearly_exact * data.spacing[center]) return Number_errors::Zero();
  const std::array<int, 2> degrees = {way.degree, way.other_degree()};
  const auto fits = fit_in_way(data, center, fit.patch.radius, way, degrees, request);
  if (fits.size() < degrees.size() || fits.back().patch.radius != fit.patch.radius) return Number_errors::Zero();
  return errors_or_all(relative_difference(fit.estimates->numbers, fits.back().estimates->numbers));
}

/// A fit gives numbers near its center, where exact data use the higher of two degrees, or it is part of a blend,
/// which extends to half of the radius and uses the lower degree.
enum class Fit_use { NUMBERS, BLEND };

/// The fit of the higher degree to exact data, if it gives K more accurately than the accuracy `lower` of the other
/// fit. Returns nothing where the fit of the lower degree is consistent with K_e = 0: its curvatures are small on
/// flat parts.
inline std::optional<Curvature_fit_3> exact_fit(const Data_points_3& data, Data_points_3::Index center,
                                                const Way_to_fit& way, const Number_request& request,
                                                const std::vector<Local_fit_3>& fits, const Fit_accuracy& lower) {
  constexpr double ratio_of_radii = 1.35, known_at_all = 0.5;
  const std::array<int, 2> degrees = {way.degree, way.other_degree()};
  const Local_fit_3& fit = fits.back();
  const double radius = fit.patch.radius;
  const Fitted_numbers& lower_numbers = fits.front().estimates->numbers;
  if (std::abs(lower_numbers.components[GAUSSIAN]) <= lower.error[GAUSSIAN] * lower_numbers.sizes()[GAUSSIAN])
    return {};
  const auto smaller = fit_in_way(data, center, radius / ratio_of_radii, way, degrees, request);
  if (smaller.size() < degrees.size() || smaller.back().patch.radius >= 0.99 * radius) return {};
  Fit_accuracy accuracy = exact_accuracy(fit, fits.front(), smaller.back(), lower.deviation);
  if (!(accuracy.error[AFFINE_GAUSSIAN] < std::min(known_at_all, lower.error[AFFINE_GAUSSIAN]))) return {};
  accuracy.radius = radius;
  return Curvature_fit_3{fit.patch, fit.estimates->numbers, accuracy};
}

/// Fits the points around a center. The errors are infinite where the degree had to be reduced, as at a corner of a
/// border, and at a scale where the radius of the ball had to change.
inline std::optional<Curvature_fit_3> curvature_fit(const Data_points_3& data, Data_points_3::Index center,
                                                    const Fit_choice& choice, const Fit_choices_3& choices,
                                                    Fit_use use) {
  constexpr int least_degree = 4;
  Way_to_fit way = choice.way;
  const double radius = choices.radius(way, center), noise = choices.noise(choice, center);
  const Number_request request = choices.number_request();
  std::vector<Local_fit_3> fits;
  for (;; way.degree -= way.family == Fit_family::HEIGHT ? 2 : 1) {
    const std::array<int, 2> degrees = {way.degree, way.other_degree()};
    fits = fit_in_way(data, center, radius, way, std::span(degrees).first(choices.scale() ? 1 : 2), request);
    if (!fits.empty()) break;
    if (way.degree <= least_degree) return {};
  }
  Local_fit_3& fit = fits.front();
  Fit_accuracy accuracy = choices.scale() ? accuracy_at_scale(fit, noise)
                                          : own_accuracy(fit, fits.back(), choice, choices.has_noise(),
                                                         data.spacing[center], fit.patch.radius / radius);
  if (way.degree < choice.way.degree || (choices.scale() && fit.patch.radius != radius))
    accuracy.error.setConstant(std::numeric_limits<double>::infinity());
  else if (choices.scale() && choices.is_scale_by_data()) {
    const Number_errors mixture =
        calibration(Source_of_error::BOTH) * mixture_at_scale(data, center, way, fit, request);
    accuracy.error = (accuracy.error.square() + mixture.square()).sqrt();
  }
  accuracy.radius = fit.patch.radius;
  const bool is_exact = way.family == Fit_family::HEIGHT && fits.size() > 1 && !choices.has_noise() &&
                        noise <= noise_of_exact_data * data.spacing[center];
  if (use == Fit_use::NUMBERS && is_exact)
    if (auto exact = exact_fit(data, center, way, request, fits, accuracy)) return exact;
  return Curvature_fit_3{std::move(fit.patch), fit.estimates->numbers, accuracy};
}

/// Fits at centers so dense that every point is close to one.
struct Patch_cover_3 {
  using Index = Data_points_3::Index;
  static constexpr Index none = std::numeric_limits<Index>::max();

  std::vector<Index> centers;
  std::vector<std::optional<Curvature_fit_3>> fits; ///< one per center, if it exists
  std::vector<Index> nearest; ///< per point, the position of its center in `centers`, or `none` without a fit
};

/// Chooses centers in random order that are no closer to each other than `part` of the radius of a fit, and fits
/// there.
inline Patch_cover_3 patch_cover(bool in_threads, const Data_points_3& data, const Fit_choices_3& choices, Fit_use use,
                                 double part) {
  using Index = Data_points_3::Index;
  Patch_cover_3 cover;
  cover.nearest.assign(data.size(), Patch_cover_3::none);
  std::vector<double> squares(data.size(), std::numeric_limits<double>::infinity());
  std::vector<std::optional<Fit_choice>> choice(data.size());
  parallel_for(
      in_threads, 0, data.size(), [&](std::size_t i) { choice[i] = choices.at(data.points[i]); }, 256);

  for (const Index i : random_subset<Index>(data.size(), data.size(), 2)) {
    if (!choice[i] || cover.nearest[i] != Patch_cover_3::none) continue;
    for (const Index j : connected_ball(data, i, part * choices.radius(choice[i]->way, i))) {
      const double square = (data.points[j] - data.points[i]).squaredNorm();
      if (!(square < squares[j])) continue;
      squares[j] = square;
      cover.nearest[j] = Index(cover.centers.size());
    }
    cover.centers.push_back(i);
  }
  cover.fits.resize(cover.centers.size());
  parallel_for(in_threads, 0, cover.centers.size(), [&](std::size_t k) {
    cover.fits[k] = curvature_fit(data, cover.centers[k], *choice[cover.centers[k]], choices, use);
  });
  return cover;
}

} // namespace equiaffine::internal

#endif
