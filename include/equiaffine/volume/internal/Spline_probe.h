// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SPLINE_PROBE_H
#define EQUIAFFINE_VOLUME_INTERNAL_SPLINE_PROBE_H

#include <equiaffine/volume/Volume_view_3.h>
#include <equiaffine/volume/internal/Line_functionals.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// Measures a spline through smoothed samples in the middle of cells, without fitting it: its value and its fourth
/// derivatives along x, y and z, in lattice coordinates, are weighted sums of the samples around the cell.
template <class Kernel>
class Spline_probe {
  using FT = typename Kernel::FT;

public:
  using Cell = std::array<std::size_t, 3>;

  Spline_probe(const Cell& size, const Spline_rule<FT>& rule) {
    for (std::size_t a = 0; a < 3; ++a) {
      const Line_functionals<FT> line(size[a], rule);
      weights_[a] = {line.kinds(), [&](std::size_t kind) { return Weights(line.rows(kind)); }};
    }
  }

  /// The value and the fourth derivatives along x, y and z.
  std::array<double, 4> measure(const Volume_view_3<Kernel>& volume, const Cell& cell) const {
    std::vector<FT> samples(weights_[0][cell[0]].value.size());
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

  /// The covariances of what this probe and another one measure in a cell, if the samples are white noise of standard
  /// deviation 1.
  Pair covariance(const Spline_probe& other, const Cell& cell) const {
    Pair result{1, 1};
    for (std::size_t a = 0; a < 3; ++a) {
      const Pair along_axis = covariance_along(a, other, cell);
      result.value *= along_axis.value;
      result.derivative *= a == 0 ? along_axis.derivative : along_axis.value;
    }
    return result;
  }

  /// The variances of the difference between what this probe and another one measure, for the same noise.
  Pair variance_of_difference(const Spline_probe& other, const Cell& cell) const {
    const Pair p = covariance(*this, cell), q = other.covariance(other, cell), pq = covariance(other, cell);
    return {std::max(0.0, p.value + q.value - 2 * pq.value),
            std::max(0.0, p.derivative + q.derivative - 2 * pq.derivative)};
  }

private:
  /// The weights of the samples along an axis, for the value and for the fourth derivative. Samples before `first` and
  /// after the last one have no influence.
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

    std::size_t first = 0; // in the line that represents this one
    std::vector<double> value, derivative;
  };

  /// The value and the fourth derivative of a line along x, from its first sample that is used.
  Pair measure_line(const std::vector<FT>& samples, std::size_t cell) const {
    const Weights& x = weights_[0][cell];
    Pair sum{0, 0};
    for (std::size_t i = 0; i < x.value.size(); ++i) {
      sum.value += x.value[i] * double(samples[i]);
      sum.derivative += x.derivative[i] * double(samples[i]);
    }
    return sum;
  }

  /// The sums of products of weights of this probe and the other one, over the samples of a line that both use.
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

  /// The first sample that is used along an axis.
  std::size_t first(std::size_t a, const Cell& cell) const {
    return weights_[a][cell[a]].first + weights_[a].offset_from_representative(cell[a]);
  }

  std::array<Per_kind_of_cell<Weights>, 3> weights_;
};

} // namespace equiaffine::internal

#endif
