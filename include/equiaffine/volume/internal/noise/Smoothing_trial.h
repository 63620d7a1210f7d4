// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_NOISE_SMOOTHING_TRIAL_H
#define EQUIAFFINE_VOLUME_INTERNAL_NOISE_SMOOTHING_TRIAL_H

#include <equiaffine/Volume_view_3.h>
#include <equiaffine/volume/internal/Line_functionals.h>
#include <equiaffine/volume/internal/local_polynomial.h>
#include <equiaffine/volume/internal/noise/Spline_probe.h>
#include <equiaffine/volume/internal/noise/noise_measurement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The cells in which scales of smoothing are compared, and the standard deviation of the noise in the samples.
template <class Kernel>
struct Smoothing_test_site {
  const Volume_view_3<Kernel>& volume;
  std::vector<std::array<std::size_t, 3>> cells;
  double deviation;
};

/// A scale of smoothing, tried at a test site: value and fourth derivatives of the spline in each of its cells.
template <class Kernel>
class Smoothing_trial {
public:
  using Site = Smoothing_test_site<Kernel>;

  Smoothing_trial(const Site& site, const Spline_rule<typename Kernel::FT>& rule)
      : probe_(site.volume.lattice().size(), rule) {
    for (const auto& cell : site.cells) measured_.push_back(probe_.measure(site.volume, cell));
  }

  /// Whether this scale moves the surface that `unsmoothed` has: in more than a tenth of the cells the value changes by
  /// more than hypot(two standard deviations of the change that noise explains, the slope times a tenth of a voxel).
  bool moves_surface(const Smoothing_trial& unsmoothed, const Site& site) const {
    const Volume_view_3<Kernel>& volume = site.volume;
    std::vector<double> excesses;
    for (std::size_t n = 0; n < site.cells.size(); ++n) {
      const auto& [i, j, k] = site.cells[n];
      const double slope = 0.5 * std::hypot(double(volume(i + 1, j, k) - volume(i - 1, j, k)),
                                            double(volume(i, j + 1, k) - volume(i, j - 1, k)),
                                            double(volume(i, j, k + 1) - volume(i, j, k - 1)));
      const double explained =
          site.deviation * std::sqrt(probe_.variance_of_difference(unsmoothed.probe_, site.cells[n]).value);
      const double excess =
          std::abs(measured_[n][0] - unsmoothed.measured_[n][0]) - std::hypot(2 * explained, 0.1 * slope);
      if (std::isfinite(excess)) excesses.push_back(std::max(excess, 0.0));
    }
    return quantile_of_magnitudes(std::move(excesses), 0.9) > 0;
  }

  /// The estimated error of fourth derivatives: their standard deviation by noise, and their bias.
  double risk(const Site& site, double bias) const {
    std::vector<double> deviations;
    for (const auto& cell : site.cells)
      deviations.push_back(site.deviation * std::sqrt(probe_.covariance(probe_, cell).derivative));
    return std::hypot(median_magnitude(std::move(deviations)), bias);
  }

  /// The estimated bias of fourth derivatives: how far they differ from those of the scale before, beyond what noise
  /// explains.
  double bias(const Smoothing_trial& last, const Site& site) const {
    std::vector<double> differences, expected;
    for (std::size_t n = 0; n < site.cells.size(); ++n) {
      expected.push_back(site.deviation *
                         std::sqrt(probe_.variance_of_difference(last.probe_, site.cells[n]).derivative));
      for (std::size_t a = 1; a < 4; ++a)
        if (const double d = last.measured_[n][a] - measured_[n][a]; std::isfinite(d)) differences.push_back(d);
    }
    const double of_noise = median_magnitude(std::move(expected));
    const double change = quantile_of_magnitudes(std::move(differences), 0.8) / quantile_80_over_deviation;
    return std::sqrt(std::max(0.0, change * change - 1.5 * of_noise * of_noise)); // 1.5, as both are uncertain
  }

private:
  Spline_probe<Kernel> probe_;
  std::vector<std::array<double, 4>> measured_; ///< the numbers of the probe in each cell
};

/// The scale with the least risk at a site; `rule` says how samples become a spline without smoothing. Scales are tried
/// in increasing order up to the first one that moves the surface or whose window does not fit into the volume.
template <class Kernel>
typename Kernel::FT least_risky_scale(const Smoothing_test_site<Kernel>& site, Spline_rule<typename Kernel::FT> rule) {
  using FT = typename Kernel::FT;
  using Trial = Smoothing_trial<Kernel>;
  const auto& size = site.volume.lattice().size();
  const std::size_t shortest = *std::min_element(size.begin(), size.end());
  const Trial unsmoothed(site, rule);
  Trial last = unsmoothed;
  double least_risk = unsmoothed.risk(site, 0);
  FT best = 0;
  for (const FT scale : {FT(1.5), FT(2), FT(2.5), FT(3), FT(4), FT(5), FT(6), FT(8)}) {
    if (2 * Smoothing_filter<FT>::radius_of(scale) + 1 > shortest) break;
    rule.smoothing = scale;
    Trial trial(site, rule);
    if (trial.moves_surface(unsmoothed, site)) break;
    const double risk = trial.risk(site, trial.bias(last, site));
    if (risk < least_risk) {
      least_risk = risk;
      best = scale;
    }
    last = std::move(trial);
  }
  return best;
}

} // namespace equiaffine::internal

#endif
