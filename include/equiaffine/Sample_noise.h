// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SAMPLE_NOISE_H
#define EQUIAFFINE_SAMPLE_NOISE_H

#include <equiaffine/Volume_3.h>
#include <equiaffine/internal/bspline_functionals.h>

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

/// Fourth derivatives along x, y and z, in lattice coordinates, of the spline through smoothed samples, in the middle
/// of cells, as sums over samples.
template <class Kernel>
class Fourth_derivative_probe {
  using FT = typename Kernel::FT;

public:
  using Cell = std::array<std::size_t, 3>;

  Fourth_derivative_probe(const Cell& size, const Spline_rule<FT>& rule) {
    for (std::size_t a = 0; a < 3; ++a) {
      const Line_functionals<FT> line(size[a], rule);
      weights_[a] = {line.kinds(), [&](std::size_t kind) { return Weights(line.rows(kind)); }};
    }
  }

  std::array<double, 3> operator()(const Volume_3<Kernel>& volume, const Cell& cell) const {
    const Weights &x = weights_[0][cell[0]], &y = weights_[1][cell[1]], &z = weights_[2][cell[2]];
    std::array<double, 3> sum{};
    for (std::size_t k = 0; k < z.value.size(); ++k) {
      double value = 0, along_x = 0, along_y = 0;
      for (std::size_t j = 0; j < y.value.size(); ++j) {
        const FT* row = &volume.values[volume.lattice.index(first(0, cell), first(1, cell) + j, first(2, cell) + k)];
        double line = 0, derivative = 0;
        for (std::size_t i = 0; i < x.value.size(); ++i) {
          line += x.value[i] * double(row[i]);
          derivative += x.derivative[i] * double(row[i]);
        }
        value += y.value[j] * line;
        along_x += y.value[j] * derivative;
        along_y += y.derivative[j] * line;
      }
      sum[0] += z.value[k] * along_x;
      sum[1] += z.value[k] * along_y;
      sum[2] += z.derivative[k] * value;
    }
    return sum;
  }

  /// The covariance of the derivative along x of this one and of another, for white noise of deviation 1.
  double covariance(const Fourth_derivative_probe& other, const Cell& cell) const {
    double result = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const Weights &p = weights_[a][cell[a]], &q = other.weights_[a][cell[a]];
      const std::size_t begin = std::max(first(a, cell), other.first(a, cell));
      double sum = 0;
      for (std::size_t n = begin; n - first(a, cell) < p.value.size() && n - other.first(a, cell) < q.value.size();
           ++n) {
        const std::size_t i = n - first(a, cell), j = n - other.first(a, cell);
        sum += a == 0 ? p.derivative[i] * q.derivative[j] : p.value[i] * q.value[j];
      }
      result *= sum;
    }
    return result;
  }

private:
  /// Of the samples from some first one on, counted in the cell of that kind whose functionals are known.
  struct Weights {
    explicit Weights(const typename Line_functionals<FT>::Rows& rows) {
      const auto is_used = [&](std::size_t j) { return rows[0][j] != 0 || rows[4][j] != 0; };
      std::size_t end = rows[0].size();
      while (first + 1 < end && !is_used(first)) ++first;
      while (end > first + 1 && !is_used(end - 1)) --end;
      for (std::size_t j = first; j < end; ++j) {
        value.push_back(double(rows[0][j]));
        derivative.push_back(double(24 * rows[4][j]));
      }
    }

    std::size_t first = 0;
    std::vector<double> value, derivative;
  };

  /// The first sample that is used along an axis.
  std::size_t first(std::size_t a, const Cell& cell) const {
    return weights_[a][cell[a]].first + weights_[a].distance(cell[a]);
  }

  std::array<Per_kind_of_cell<Weights>, 3> weights_;
};

} // namespace internal

/// The scale for smooth_volume with the least estimated error of fourth derivatives, out of 0, 1.5, 2, 2.5, 3, 4, 5, 6
/// and 8: noise is known from its deviation, and what smoothing takes away from the function is what the derivatives
/// differ from those at the scale before, beyond their noise, in most of some hundred cells beside the level set.
/// Scales whose window does not fit into the volume are left out, and 0 is chosen where there is no spline.
template <class Kernel>
typename Kernel::FT choose_smoothing(const Volume_3<Kernel>& volume, const Sample_noise& noise, int degree,
                                     Spline_scheme scheme, std::optional<typename Kernel::FT> isovalue = std::nullopt) {
  using FT = typename Kernel::FT;
  using Probe = internal::Fourth_derivative_probe<Kernel>;
  if (scheme == Spline_scheme::INTERPOLATION) scheme = Spline_scheme::QUASI_INTERPOLATION; // the same but for its reach
  const std::size_t shortest = *std::min_element(volume.lattice.size().begin(), volume.lattice.size().end());
  const auto cells = internal::nodes_to_measure(volume, isovalue, 1, 300);
  if (shortest <= std::size_t(degree) || cells.empty()) return 0;
  std::optional<Probe> last;
  double least_risk = 0;
  FT best = 0;
  for (const FT scale : {FT(0), FT(1.5), FT(2), FT(2.5), FT(3), FT(4), FT(5), FT(6), FT(8)}) {
    if (2 * internal::Smoothing_filter<FT>::radius_of(scale) + 1 > shortest) break;
    Probe probe(volume.lattice.size(), {degree, scheme, scale});
    std::vector<double> deviations, differences, expected;
    for (const auto& cell : cells) {
      const double variance = probe.covariance(probe, cell);
      deviations.push_back(noise.deviation * std::sqrt(variance));
      if (!last) continue;
      const double change = variance + last->covariance(*last, cell) - 2 * last->covariance(probe, cell);
      expected.push_back(noise.deviation * std::sqrt(std::max(change, 0.0)));
      const auto fine = (*last)(volume, cell), coarse = probe(volume, cell);
      for (std::size_t a = 0; a < 3; ++a)
        if (std::isfinite(fine[a] - coarse[a])) differences.push_back(fine[a] - coarse[a]);
    }
    const double of_noise = internal::median_magnitude(std::move(expected));
    const double found = internal::quantile_of_magnitudes(std::move(differences), 0.8) / internal::most_over_deviation;
    const double bias = std::sqrt(std::max(0.0, found * found - 1.5 * of_noise * of_noise)); // both are uncertain
    const double risk = std::hypot(internal::median_magnitude(std::move(deviations)), bias);
    if (!last || risk < least_risk) {
      least_risk = risk;
      best = scale;
    }
    last.emplace(std::move(probe));
  }
  return best;
}

} // namespace equiaffine

#endif
