// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SMOOTHING_TRIAL_H
#define EQUIAFFINE_VOLUME_INTERNAL_SMOOTHING_TRIAL_H

#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/internal/Spline_probe.h>
#include <equiaffine/volume/internal/noise_measurement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

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

} // namespace equiaffine::internal

#endif
