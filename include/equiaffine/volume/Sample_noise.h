// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SAMPLE_NOISE_H
#define EQUIAFFINE_VOLUME_SAMPLE_NOISE_H

#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/internal/Smoothing_trial.h>
#include <equiaffine/volume/internal/border_degree.h>
#include <equiaffine/volume/internal/noise_measurement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine {

/// Errors of the samples of a volume, in the unit of the samples.
struct Sample_noise {
  double deviation; ///< standard deviation of what is white in them, rounding of their type included
  double quantum;   ///< the step of their type: 1 for integers, that of floats of median size, else 0
};

/// Estimates the noise beside the level set f = isovalue, or everywhere if there is none, from differences of order 12
/// along the axes, of which a smooth function has next to nothing: their median, in units of that of white noise. What
/// the function itself has at such a wavelength counts as noise. Integers have at least that of rounding, 1 / sqrt(12).
/// Volumes with less than 13 nodes along an axis say nothing. Cost: that of some passes over the samples.
template <class Kernel>
Sample_noise estimate_noise(const Volume_3<Kernel>& volume,
                            std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  constexpr std::array<double, 7> half = {924, -792, 495, -220, 66, -12, 1}; // binomial(12, k), signs alternating
  constexpr double norm = 1644.4390289215653;                                // sqrt(binomial(24, 12))
  const std::array<std::size_t, 3> stride = {1, volume.lattice.size()[0],
                                             volume.lattice.size()[0] * volume.lattice.size()[1]};
  std::vector<double> differences;
  for (const auto& [i, j, k] : internal::nodes_to_measure(volume, isovalue, 6, 40000)) {
    const auto* center = &volume.values[volume.lattice.index(i, j, k)];
    for (const std::size_t s : stride) {
      double sum = half[0] * double(*center);
      for (std::size_t n = 1; n < half.size(); ++n)
        sum += half[n] * (double(center[n * s]) + double(*(center - n * s)));
      if (std::isfinite(sum)) differences.push_back(sum / norm);
    }
  }
  const double quantum = internal::quantum_of(volume);
  const double deviation = internal::median_magnitude(std::move(differences)) / internal::median_over_deviation;
  return {std::max(deviation, quantum == 1 ? 1 / std::sqrt(12.0) : 0), quantum};
}

/// The scale for smooth_volume with the least estimated error of fourth derivatives, out of 0, 1.5, 2, 2.5, 3, 4, 5, 6
/// and 8, among those that leave the surface where it is.
///
/// Noise is known from its deviation, and what smoothing takes away from the function is what the derivatives differ
/// from those at the scale before, beyond their noise, in most of some hundred cells beside the level set. A scale, and
/// all larger ones, is left out where in more than a tenth of these cells the value changes by more than hypot(2 s, g):
/// s is the standard deviation of the change that noise explains (the discrepancy principle: Morozov, On the solution
/// of functional equations by the method of regularization, 1966), g the slope times a tenth of a voxel, below which
/// details are interpolated anyway. Fourth derivatives of a scan that has details of a few voxels are wrong at every
/// scale, the larger ones wear the details away.
///
/// Scales whose window does not fit into the volume are left out, and 0 is chosen where there is no spline.
template <class Kernel>
typename Kernel::FT choose_smoothing(const Volume_3<Kernel>& volume, const Sample_noise& noise, int degree,
                                     Spline_scheme scheme, std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  using FT = typename Kernel::FT;
  using Trial = internal::Smoothing_trial<Kernel>;
  if (scheme == Spline_scheme::INTERPOLATION) scheme = Spline_scheme::QUASI_INTERPOLATION; // the same but for its reach
  const std::size_t shortest = *std::min_element(volume.lattice.size().begin(), volume.lattice.size().end());
  const auto cells = internal::nodes_to_measure(volume, isovalue, 1, 300);
  if (shortest <= std::size_t(degree) || cells.empty()) return 0;
  const int border_degree = internal::border_degree(volume.values, volume.lattice.size(), degree, scheme);
  const Trial unsmoothed(volume, cells, {degree, scheme, border_degree, FT(0)});
  Trial last = unsmoothed;
  double least_risk = unsmoothed.risk(nullptr, cells, noise.deviation);
  FT best = 0;
  for (const FT scale : {FT(1.5), FT(2), FT(2.5), FT(3), FT(4), FT(5), FT(6), FT(8)}) {
    if (2 * internal::Smoothing_filter<FT>::radius_of(scale) + 1 > shortest) break;
    Trial trial(volume, cells, {degree, scheme, border_degree, scale});
    if (trial.moves_surface(unsmoothed, volume, cells, noise.deviation)) break;
    const double risk = trial.risk(&last, cells, noise.deviation);
    if (risk < least_risk) {
      least_risk = risk;
      best = scale;
    }
    last = std::move(trial);
  }
  return best;
}

} // namespace equiaffine

#endif
