// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_NOISE_MEASUREMENT_H
#define EQUIAFFINE_VOLUME_INTERNAL_NOISE_MEASUREMENT_H

#include <equiaffine/Progress_observer.h>
#include <equiaffine/Volume_3.h>
#include <equiaffine/base/internal/shared/quantile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// The least |x| that at least the given fraction of all |x| do not exceed; 0 if there are none.
inline double quantile_of_magnitudes(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  for (double& x : values) x = std::abs(x);
  const auto n = std::size_t(fraction * double(values.size() - 1));
  return nth_smallest(std::move(values), n);
}

inline double median_magnitude(std::vector<double> values) { return quantile_of_magnitudes(std::move(values), 0.5); }

/// The quantiles of |x| for a normal variable x, over its standard deviation.
inline constexpr double median_over_deviation = 0.67448975019608174, quantile_80_over_deviation = 1.2815515655446004;

/// Whether node (i, j, k) has a value and, if there is an isovalue, the next node along an axis is on the other side.
template <class Kernel>
bool is_beside_level_set(const Volume_3<Kernel>& volume, std::optional<typename Kernel::FT> isovalue, std::size_t i,
                         std::size_t j, std::size_t k) {
  const std::array<std::size_t, 3>& size = volume.lattice.size();
  const auto value = volume(i, j, k);
  if (!isovalue || !std::isfinite(value)) return std::isfinite(value);
  const bool side = value < *isovalue;
  return (i + 1 < size[0] && (volume(i + 1, j, k) < *isovalue) != side) ||
         (j + 1 < size[1] && (volume(i, j + 1, k) < *isovalue) != side) ||
         (k + 1 < size[2] && (volume(i, j, k + 1) < *isovalue) != side);
}

/// Some hundred or thousand nodes where noise matters and can be measured: about `most` of those beside the level set,
/// or of all if no isovalue is given or nothing has it; all at least `margin` nodes from the border.
template <class Kernel>
std::vector<std::array<std::size_t, 3>> nodes_to_measure(const Volume_3<Kernel>& volume,
                                                         std::optional<typename Kernel::FT> isovalue,
                                                         std::size_t margin, std::size_t most) {
  const std::array<std::size_t, 3>& size = volume.lattice.size();
  if (*std::min_element(size.begin(), size.end()) <= 2 * margin) return {};
  const auto for_each_node = [&](const auto& visit) {
    for (std::size_t k = margin; k < size[2] - margin; ++k)
      for (std::size_t j = margin; j < size[1] - margin; ++j) {
        Progress_observer::step();
        for (std::size_t i = margin; i < size[0] - margin; ++i)
          if (is_beside_level_set(volume, isovalue, i, j, k)) visit(std::array{i, j, k});
      }
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

/// The step of the samples' type, judged by some 65536 of them: 1 if all are integers, the step between floats of
/// median size if all are floats, else 0.
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

/// The standard deviation of white noise at some nodes, each at least 6 nodes from the border: from the median of the
/// differences of order 12 along the axes.
template <class Kernel>
double white_noise_deviation(const Volume_3<Kernel>& volume, const std::vector<std::array<std::size_t, 3>>& nodes) {
  constexpr std::array<double, 7> half = {924, -792, 495, -220, 66, -12, 1}; // binomial(12, k), signs alternating
  constexpr double norm = 1644.4390289215653;                                // sqrt(binomial(24, 12))
  const auto& size = volume.lattice.size();
  const std::array<std::size_t, 3> strides = {1, size[0], size[0] * size[1]};
  std::vector<double> differences;
  for (const auto& [i, j, k] : nodes) {
    const auto* center = &volume.values[volume.lattice.index(i, j, k)];
    for (const std::size_t s : strides) {
      double sum = half[0] * double(*center);
      for (std::size_t n = 1; n < half.size(); ++n)
        sum += half[n] * (double(center[n * s]) + double(*(center - n * s)));
      if (std::isfinite(sum)) differences.push_back(sum / norm);
    }
  }
  return median_magnitude(std::move(differences)) / median_over_deviation;
}

} // namespace equiaffine::internal

#endif
