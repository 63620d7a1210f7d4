// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SAMPLE_NOISE_H
#define EQUIAFFINE_VOLUME_SAMPLE_NOISE_H

#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/internal/Spline_probe.h>
#include <equiaffine/volume/internal/border_degree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine {

/// Errors of the samples of a volume, in the unit of the samples.
struct Sample_noise {
  double deviation; ///< standard deviation of what is white in them, rounding of their type included
  double quantum;   ///< the step of their type: 1 for integers, that of floats of median size, else 0
};

namespace internal {

/// The least number that the given part of the |x| does not exceed; 0 of nothing.
inline double quantile_of_magnitudes(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  for (double& x : values) x = std::abs(x);
  const auto place = values.begin() + std::ptrdiff_t(part * double(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

inline double median_magnitude(std::vector<double> values) { return quantile_of_magnitudes(std::move(values), 0.5); }

/// The median of |x| and the number that 80 % of them do not exceed, over the standard deviation of a normal variable.
inline constexpr double median_over_deviation = 0.67448975019608174, most_over_deviation = 1.2815515655446004;

/// Nodes of a volume where noise matters and can be measured: every n-th of those beside the level set, of all if no
/// level is given or none has it, at least `margin` nodes from the border and with a finite value.
template <class Kernel>
std::vector<std::array<std::size_t, 3>> nodes_to_measure(const Volume_3<Kernel>& volume,
                                                         std::optional<typename Kernel::FT> isovalue,
                                                         std::size_t margin, std::size_t most) {
  const std::array<std::size_t, 3>& size = volume.lattice.size();
  if (*std::min_element(size.begin(), size.end()) <= 2 * margin) return {};
  const auto is_chosen = [&](std::size_t i, std::size_t j, std::size_t k) {
    const auto value = volume(i, j, k);
    if (!isovalue || !std::isfinite(value)) return std::isfinite(value);
    const bool side = value < *isovalue;
    return (i + 1 < size[0] && (volume(i + 1, j, k) < *isovalue) != side) ||
           (j + 1 < size[1] && (volume(i, j + 1, k) < *isovalue) != side) ||
           (k + 1 < size[2] && (volume(i, j, k + 1) < *isovalue) != side);
  };
  const auto for_each_node = [&](const auto& visit) {
    for (std::size_t k = margin; k < size[2] - margin; ++k)
      for (std::size_t j = margin; j < size[1] - margin; ++j)
        for (std::size_t i = margin; i < size[0] - margin; ++i)
          if (is_chosen(i, j, k)) visit(std::array{i, j, k});
  };
  std::size_t count = 0, n = 0;
  for_each_node([&](const auto&) { ++count; });
  if (count == 0 && isovalue) return nodes_to_measure<Kernel>(volume, std::nullopt, margin, most);
  const std::size_t step = count / most + 1;
  std::vector<std::array<std::size_t, 3>> nodes;
  for_each_node([&](const auto& node) {
    if (n++ % step == step / 2) nodes.push_back(node);
  });
  return nodes;
}

/// 1 if all samples are integers, the step between floats of median size if all are floats, else 0.
template <class Kernel>
double quantum_of(const Volume_3<Kernel>& volume) {
  bool are_integers = true, are_floats = true;
  std::vector<double> finite;
  const std::size_t step = volume.values.size() / 65536 + 1;
  for (std::size_t n = 0; n < volume.values.size(); n += step) {
    const double value = double(volume.values[n]);
    if (!std::isfinite(value)) continue;
    are_integers = are_integers && value == std::nearbyint(value);
    are_floats = are_floats && value == double(float(value));
    finite.push_back(value);
  }
  if (finite.empty()) return 0;
  if (are_integers) return 1;
  return are_floats ? median_magnitude(finite) * double(std::numeric_limits<float>::epsilon()) : 0;
}

} // namespace internal

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

namespace internal {

/// A scale of smoothing and what it makes of the cells in which scales are compared.
template <class Kernel>
struct Smoothing_trial {
  using Cells = std::vector<std::array<std::size_t, 3>>;

  Smoothing_trial(const Volume_3<Kernel>& volume, const Cells& cells, const Spline_rule<typename Kernel::FT>& rule)
      : probe(volume.lattice.size(), rule) {
    for (const auto& cell : cells) found.push_back(probe(volume, cell));
  }

  /// Whether this scale moves the surface that `unsmoothed` has: in more than a tenth of the cells the value changes by
  /// more than two standard deviations of what noise explains and a tenth of a voxel along the gradient together.
  bool moves_surface(const Smoothing_trial& unsmoothed, const Volume_3<Kernel>& volume, const Cells& cells,
                     double deviation) const {
    std::vector<double> excesses;
    for (std::size_t n = 0; n < cells.size(); ++n) {
      const auto& [i, j, k] = cells[n];
      const double slope = 0.5 * std::hypot(double(volume(i + 1, j, k) - volume(i - 1, j, k)),
                                            double(volume(i, j + 1, k) - volume(i, j - 1, k)),
                                            double(volume(i, j, k + 1) - volume(i, j, k - 1)));
      const double explained = deviation * std::sqrt(probe.change(unsmoothed.probe, cells[n]).value);
      const double excess = std::abs(found[n][0] - unsmoothed.found[n][0]) - std::hypot(2 * explained, 0.1 * slope);
      if (std::isfinite(excess)) excesses.push_back(std::max(excess, 0.0));
    }
    return quantile_of_magnitudes(std::move(excesses), 0.9) > 0;
  }

  /// The estimated error of fourth derivatives, by what they differ from those of the scale before, if there is one.
  double risk(const Smoothing_trial* last, const Cells& cells, double deviation) const {
    std::vector<double> deviations, differences, expected;
    for (std::size_t n = 0; n < cells.size(); ++n) {
      deviations.push_back(deviation * std::sqrt(probe.covariance(probe, cells[n]).derivative));
      if (!last) continue;
      expected.push_back(deviation * std::sqrt(probe.change(last->probe, cells[n]).derivative));
      for (std::size_t a = 1; a < 4; ++a)
        if (const double d = last->found[n][a] - found[n][a]; std::isfinite(d)) differences.push_back(d);
    }
    const double of_noise = median_magnitude(std::move(expected));
    const double change = quantile_of_magnitudes(std::move(differences), 0.8) / most_over_deviation;
    const double bias = std::sqrt(std::max(0.0, change * change - 1.5 * of_noise * of_noise)); // both are uncertain
    return std::hypot(median_magnitude(std::move(deviations)), bias);
  }

  Spline_probe<Kernel> probe;
  std::vector<std::array<double, 4>> found; // by the probe, in each cell
};

} // namespace internal

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
