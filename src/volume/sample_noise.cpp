// SPDX-License-Identifier: GPL-3.0-or-later
#include "volume/nodes_to_measure.h"
#include <equiaffine/base/Progress_observer.h>
#include <equiaffine/base/internal/quantile.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Sample_noise.h>
#include <equiaffine/volume/Spline_function_3.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_options.h>
#include <equiaffine/volume/Volume_survey.h>
#include <equiaffine/volume/internal/Line_functionals.h>
#include <equiaffine/volume/smooth_volume.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace equiaffine::internal {

namespace {

/// The smallest |x| that at least the given fraction of all |x| do not exceed; 0 if there are none.
double quantile_of_magnitudes(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  for (double& x : values) x = std::abs(x);
  const auto n = std::size_t(fraction * double(values.size() - 1));
  return nth_smallest(std::move(values), n);
}

double median_magnitude(std::vector<double> values) { return quantile_of_magnitudes(std::move(values), 0.5); }

/// The quantiles of |x| for a normal variable x, over its standard deviation.
constexpr double median_over_deviation = 0.67448975019608174, quantile_80_over_deviation = 1.2815515655446004;

/// The resolution of the samples' type, judged by about 65536 of them: 1 if all are integers, the spacing of floats
/// of median size if all are floats, else 0.
double quantum_of(const Volume_parts& volume) {
  const std::array<std::size_t, 3>& size = volume.lattice.size();
  const std::size_t nodes = volume.lattice.number_of_nodes(), step = nodes / 65536 + 1;
  std::vector<double> finite;
  for (const auto& [part, cells] : volume.parts)
    for (std::size_t n = 0; n < nodes; n += step) {
      const std::array<std::size_t, 3> node = {n % size[0], n / size[0] % size[1], n / size[0] / size[1]};
      bool is_own = true;
      for (std::size_t a = 0; a < 3; ++a) {
        const Line_part own = own_nodes_of(cells, a, size[a]);
        is_own = is_own && own.first <= node[a] && node[a] < own.end;
      }
      if (!is_own) continue;
      const double value = double(part(node[0], node[1], node[2]));
      if (std::isfinite(value)) finite.push_back(value);
    }
  finite = volume.gather(std::move(finite));
  if (finite.empty()) return 0;
  if (std::all_of(finite.begin(), finite.end(), [](double x) { return x == std::nearbyint(x); })) return 1;
  if (!std::all_of(finite.begin(), finite.end(), [](double x) { return x == double(float(x)); })) return 0;
  return median_magnitude(std::move(finite)) * double(std::numeric_limits<float>::epsilon());
}

/// The standard deviation of white noise at some nodes, each at least 6 nodes from the border, from the median of the
/// differences of order 12 along the axes.
double white_noise_deviation(const Volume_parts& volume, const Nodes_of_parts& nodes) {
  constexpr std::array<double, 7> half = {924, -792, 495, -220, 66, -12, 1}; // binomial(12, k), signs alternating
  constexpr double norm = 1644.4390289215653;                                // sqrt(binomial(24, 12))
  constexpr std::size_t reach = half.size() - 1;
  std::array<double, 2 * reach + 1> line;
  std::vector<double> differences;
  for (std::size_t p = 0; p < nodes.size(); ++p)
    for (const auto& node : nodes[p])
      for (std::size_t axis = 0; axis < 3; ++axis) {
        auto first = node;
        first[axis] -= reach;
        volume.parts[p].volume.copy_line(first, axis, line);
        double sum = half[0] * double(line[reach]);
        for (std::size_t n = 1; n <= reach; ++n) sum += half[n] * (double(line[reach + n]) + double(line[reach - n]));
        if (std::isfinite(sum)) differences.push_back(sum / norm);
      }
  return median_magnitude(volume.gather(std::move(differences))) / median_over_deviation;
}

/// Measures the spline through smoothed samples in the middle of cells without computing it: its value and its fourth
/// derivatives along x, y, and z, in lattice coordinates, are weighted sums of the samples around the cell.
class Spline_probe {
public:
  using Cell = std::array<std::size_t, 3>;

  Spline_probe(const Cell& size, const Spline_rule<double>& rule) {
    for (std::size_t a = 0; a < 3; ++a) {
      const Line_functionals<double> line(size[a], rule);
      weights_[a] = {line.kinds(), [&](std::size_t kind) { return Weights(line.rows(kind)); }};
    }
  }

  /// The value and the fourth derivatives along x, y, and z.
  std::array<double, 4> measure(const Volume_view& volume, const Cell& cell) const {
    std::vector<double> samples(weights_[0][cell[0]].value.size());
    const Weights &y = weights_[1][cell[1]], &z = weights_[2][cell[2]];
    std::array<double, 4> sum{};
    for (std::size_t k = 0; k < z.value.size(); ++k) {
      double value = 0, along_x = 0, along_y = 0;
      for (std::size_t j = 0; j < y.value.size(); ++j) {
        const std::array<std::size_t, 3> node = {first(0, cell), first(1, cell) + j, first(2, cell) + k};
        volume.copy_line(node, 0, samples);
        const Pair line = measure_line(samples, cell[0]);
        value += y.value[j] * line.value;
        along_x += y.value[j] * line.derivative;
        along_y += y.derivative[j] * line.value;
      }
      sum[0] += z.value[k] * value;
      sum[1] += z.value[k] * along_x;
      sum[2] += z.value[k] * along_y;
      sum[3] += z.derivative[k] * value;
    }
    return sum;
  }

  /// A number for the value and one for the fourth derivative along x.
  struct Pair {
    double value, derivative;
  };

  /// The covariances of the measurements of this probe and another one in a cell, if the samples are white noise of
  /// standard deviation 1.
  Pair covariance(const Spline_probe& other, const Cell& cell) const {
    Pair result{1, 1};
    for (std::size_t a = 0; a < 3; ++a) {
      const Pair along_axis = covariance_along(a, other, cell);
      result.value *= along_axis.value;
      result.derivative *= a == 0 ? along_axis.derivative : along_axis.value;
    }
    return result;
  }

  /// The variances of the difference between the measurements of this probe and another one under the same noise.
  Pair variance_of_difference(const Spline_probe& other, const Cell& cell) const {
    const Pair p = covariance(*this, cell), q = other.covariance(other, cell), pq = covariance(other, cell);
    return {std::max(0.0, p.value + q.value - 2 * pq.value),
            std::max(0.0, p.derivative + q.derivative - 2 * pq.derivative)};
  }

private:
  /// The weights of the samples along an axis, for the value and for the fourth derivative. Samples outside the range
  /// have weight 0.
  struct Weights {
    explicit Weights(const typename Line_functionals<double>::Rows& rows) {
      const auto is_used = [&](std::size_t j) { return rows[0][j] != 0 || rows[4][j] != 0; };
      std::size_t end = rows[0].size();
      while (first + 1 < end && !is_used(first)) ++first;
      while (end > first + 1 && !is_used(end - 1)) --end;
      for (std::size_t j = first; j < end; ++j) {
        value.push_back(double(rows[0][j]));
        derivative.push_back(double(24 * rows[4][j]));
      }
    }

    std::size_t first = 0; // in the representative line
    std::vector<double> value, derivative;
  };

  /// The value and the fourth derivative of a line along x, from its first sample with a weight.
  Pair measure_line(const std::vector<double>& samples, std::size_t cell) const {
    const Weights& x = weights_[0][cell];
    Pair sum{0, 0};
    for (std::size_t i = 0; i < x.value.size(); ++i) {
      sum.value += x.value[i] * double(samples[i]);
      sum.derivative += x.derivative[i] * double(samples[i]);
    }
    return sum;
  }

  /// The sums of products of the weights of this probe and the other one, over the samples of a line that both use.
  Pair covariance_along(std::size_t a, const Spline_probe& other, const Cell& cell) const {
    const Weights &p = weights_[a][cell[a]], &q = other.weights_[a][cell[a]];
    const std::size_t first_p = first(a, cell), first_q = other.first(a, cell);
    Pair sum{0, 0};
    for (std::size_t n = std::max(first_p, first_q); n - first_p < p.value.size() && n - first_q < q.value.size();
         ++n) {
      sum.value += p.value[n - first_p] * q.value[n - first_q];
      sum.derivative += p.derivative[n - first_p] * q.derivative[n - first_q];
    }
    return sum;
  }

  /// The first sample with a weight along an axis.
  std::size_t first(std::size_t a, const Cell& cell) const {
    return weights_[a][cell[a]].first + weights_[a].offset_from_representative(cell[a]);
  }

  std::array<Per_kind_of_cell<Weights>, 3> weights_;
};

/// The cells in which smoothing scales are compared, and the standard deviation of the noise in the samples.
class Smoothing_test_site {
public:
  using Cell = std::array<std::size_t, 3>;

  using Numbers = std::array<double, 4>;

  /// `cells` are those of each part that this process has. All processes gather all of them.
  Smoothing_test_site(const Volume_parts& volume, const Nodes_of_parts& cells, double deviation)
      : volume_(volume), own_cells_(cells), deviation_(deviation) {
    const auto cells_and_slopes = measure([](const Volume_view& samples, const Cell& cell) -> Numbers {
      const auto& [i, j, k] = cell;
      const double slope = 0.5 * std::hypot(double(samples(i + 1, j, k) - samples(i - 1, j, k)),
                                            double(samples(i, j + 1, k) - samples(i, j - 1, k)),
                                            double(samples(i, j, k + 1) - samples(i, j, k - 1)));
      return {double(i), double(j), double(k), slope};
    });
    for (const auto& [i, j, k, slope] : cells_and_slopes) {
      cells_.push_back({std::size_t(i), std::size_t(j), std::size_t(k)});
      slopes_.push_back(slope);
    }
  }

  const std::array<std::size_t, 3>& size() const { return volume_.lattice.size(); } ///< number of nodes along each axis
  const std::vector<Cell>& cells() const { return cells_; }
  const std::vector<double>& slopes() const { return slopes_; } ///< of the samples in each cell, per step
  double deviation() const { return deviation_; }

  /// Returns the results of measure_cell(samples, cell) for all cells in their order.
  template <class Measure_cell>
  std::vector<Numbers> measure(const Measure_cell& measure_cell) const {
    std::vector<double> own;
    for (std::size_t p = 0; p < own_cells_.size(); ++p)
      for (const Cell& cell : own_cells_[p]) {
        Progress_observer::step();
        const Numbers numbers = measure_cell(volume_.parts[p].volume, cell);
        own.insert(own.end(), numbers.begin(), numbers.end());
      }
    const std::vector<double> all = volume_.gather(std::move(own));
    std::vector<Numbers> result(all.size() / 4);
    for (std::size_t n = 0; n < all.size(); ++n) result[n / 4][n % 4] = all[n];
    return result;
  }

  /// The number of the first process: the others may have rounded differently but must make the same decision.
  double agreed(double number) const { return volume_.gather({number}).front(); }

private:
  const Volume_parts& volume_;
  Nodes_of_parts own_cells_;
  double deviation_;
  std::vector<Cell> cells_;
  std::vector<double> slopes_;
};

/// A smoothing scale tried at a test site: value and fourth derivatives of the spline in each of its cells.
class Smoothing_trial {
public:
  using Site = Smoothing_test_site;

  Smoothing_trial(const Site& site, const Spline_rule<double>& rule) : probe_(site.size(), rule) {
    measured_ =
        site.measure([&](const Volume_view& samples, const auto& cell) { return probe_.measure(samples, cell); });
  }

  /// The number of cells in which the spline has a value, because all samples in their windows are finite.
  std::size_t number_of_values() const {
    return std::size_t(
        std::count_if(measured_.begin(), measured_.end(), [](const auto& cell) { return std::isfinite(cell[0]); }));
  }

  /// Whether this scale moves the surface of `unsmoothed`: in more than a tenth of the cells there is no value any
  /// more, or it changes by more than hypot(two standard deviations of the change that noise explains, the slope
  /// times a tenth of a voxel).
  bool moves_surface(const Smoothing_trial& unsmoothed, const Site& site) const {
    std::size_t compared = 0, moved = 0;
    for (std::size_t n = 0; n < site.cells().size(); ++n) {
      if (!std::isfinite(unsmoothed.measured_[n][0])) continue;
      const double explained =
          site.deviation() * std::sqrt(probe_.variance_of_difference(unsmoothed.probe_, site.cells()[n]).value);
      const double change = std::abs(measured_[n][0] - unsmoothed.measured_[n][0]);
      ++compared;
      moved += !(change <= std::hypot(2 * explained, 0.1 * site.slopes()[n])); // true also without a value
    }
    return 10 * moved > compared;
  }

  /// The estimated error of fourth derivatives from their standard deviation under noise and their bias.
  double risk(const Site& site, double bias) const {
    std::vector<double> deviations;
    for (const auto& cell : site.cells())
      deviations.push_back(site.deviation() * std::sqrt(probe_.covariance(probe_, cell).derivative));
    return std::hypot(median_magnitude(std::move(deviations)), bias);
  }

  /// The estimated bias of fourth derivatives: their change since the last scale, beyond what noise explains.
  double bias(const Smoothing_trial& last, const Site& site) const {
    std::vector<double> differences, expected;
    for (std::size_t n = 0; n < site.cells().size(); ++n) {
      expected.push_back(site.deviation() *
                         std::sqrt(probe_.variance_of_difference(last.probe_, site.cells()[n]).derivative));
      for (std::size_t a = 1; a < 4; ++a)
        if (const double d = last.measured_[n][a] - measured_[n][a]; std::isfinite(d)) differences.push_back(d);
    }
    const double of_noise = median_magnitude(std::move(expected));
    const double change = quantile_of_magnitudes(std::move(differences), 0.8) / quantile_80_over_deviation;
    return std::sqrt(std::max(0.0, change * change - 1.5 * of_noise * of_noise)); // 1.5 because both are uncertain
  }

private:
  Spline_probe probe_;
  std::vector<typename Site::Numbers> measured_; ///< the measurements of the probe in each cell
};

/// The scale with the least risk at a site, for the rule that turns samples into a spline without smoothing. Scales
/// are tried in increasing order up to the first one that moves the surface or whose window does not fit into the
/// volume.
double least_risky_scale(const Smoothing_test_site& site, Spline_rule<double> rule) {
  using Trial = Smoothing_trial;
  const std::size_t shortest = *std::min_element(site.size().begin(), site.size().end());
  const Trial unsmoothed(site, rule);
  if (unsmoothed.number_of_values() == 0) return 0;
  Trial last = unsmoothed;
  double least_risk = unsmoothed.risk(site, 0);
  double best = 0;
  for (const double scale : scales_to_try) {
    if (2 * Smoothing_filter<double>::radius_of(scale) + 1 > shortest) break;
    rule.smoothing = scale;
    Trial trial(site, rule);
    constexpr double moves = std::numeric_limits<double>::infinity();
    const double risk =
        site.agreed(trial.moves_surface(unsmoothed, site) ? moves : trial.risk(site, trial.bias(last, site)));
    if (risk == moves) break;
    if (risk < least_risk) {
      least_risk = risk;
      best = scale;
    }
    last = std::move(trial);
  }
  return best;
}

} // namespace

Sample_noise noise_of_samples(bool in_threads, const Volume_parts& volume, std::optional<double> level) {
  constexpr std::size_t reach = 6;
  for (const auto& [part, cells] : volume.parts)
    check_known_cells(part, widened(cells, reach, cells_of(volume.lattice.size())));
  const double deviation = white_noise_deviation(volume, nodes_to_measure(in_threads, volume, level, reach, 40000));
  const double quantum = quantum_of(volume);
  return {std::max(deviation, quantum == 1 ? 1 / std::sqrt(12.0) : 0), quantum};
}

double smoothing_of_samples(bool in_threads, const Volume_parts& volume, const Sample_noise& noise,
                            const Volume_options& options) {
  const int degree = options.spline_degree;
  const Spline_scheme scheme = options.spline_scheme == Spline_scheme::INTERPOLATION
                                   ? Spline_scheme::QUASI_INTERPOLATION // the same except for its reach
                                   : options.spline_scheme;
  const auto& size = volume.lattice.size();
  if (*std::min_element(size.begin(), size.end()) <= std::size_t(degree)) return 0;
  const Volume_options greatest = {
      .smoothing = greatest_scale_to_choose, .spline_scheme = scheme, .spline_degree = degree};
  for (const auto& [part, cells] : volume.parts) check_known_cells(part, cells_to_know(cells, size, greatest));
  const Smoothing_test_site site(volume, nodes_to_measure(in_threads, volume, options.level, 1, 300), noise.deviation);
  if (site.cells().empty()) return 0;
  return least_risky_scale(site, {degree, scheme, border_degree(volume, degree, scheme), 0});
}

std::optional<std::size_t> few_values_of_samples(const Volume_parts& volume) {
  constexpr std::size_t most_values = 256, most_rows = 4096;
  const auto [nx, ny, nz] = volume.lattice.size();
  const std::size_t step = 1 + ny * nz / most_rows;
  std::set<double> values;
  for (const auto& [part, cells] : volume.parts) {
    std::vector<double> row(cells.end[0] + 1 - cells.first[0]);
    for (std::size_t n = 0; n < ny * nz && values.size() <= most_values; n += step) {
      const std::size_t j = n % ny, k = n / ny;
      if (j < cells.first[1] || cells.end[1] < j || k < cells.first[2] || cells.end[2] < k) continue;
      part.copy_line({cells.first[0], j, k}, 0, row);
      for (std::size_t i = 0; i < row.size(); ++i)
        if (std::isfinite(row[i]) && (i == 0 || row[i] != row[i - 1])) values.insert(row[i]);
    }
  }
  const std::vector<double> of_all = volume.gather({values.begin(), values.end()});
  values.insert(of_all.begin(), of_all.end());
  if (values.size() > most_values) return std::nullopt;
  return values.size();
}

} // namespace equiaffine::internal
