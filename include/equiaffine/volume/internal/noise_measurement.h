// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_NOISE_MEASUREMENT_H
#define EQUIAFFINE_VOLUME_INTERNAL_NOISE_MEASUREMENT_H

#include <equiaffine/volume/Volume_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace equiaffine::internal {

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

} // namespace equiaffine::internal

#endif
