// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SPLINE_PROBE_H
#define EQUIAFFINE_VOLUME_INTERNAL_SPLINE_PROBE_H

#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/internal/Line_functionals.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// The value and the fourth derivatives along x, y and z, in lattice coordinates, of the spline through smoothed
/// samples, in the middle of cells, as sums over samples.
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

  std::array<double, 4> operator()(const Volume_3<Kernel>& volume, const Cell& cell) const {
    const Weights &x = weights_[0][cell[0]], &y = weights_[1][cell[1]], &z = weights_[2][cell[2]];
    std::array<double, 4> sum{};
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
      sum[0] += z.value[k] * value;
      sum[1] += z.value[k] * along_x;
      sum[2] += z.value[k] * along_y;
      sum[3] += z.derivative[k] * value;
    }
    return sum;
  }

  /// Covariances for white noise of deviation 1.
  struct Covariance {
    double value, derivative;
  };

  /// Of the value and of the derivative along x, of this one and of another.
  Covariance covariance(const Spline_probe& other, const Cell& cell) const {
    Covariance result{1, 1};
    for (std::size_t a = 0; a < 3; ++a) {
      const Weights &p = weights_[a][cell[a]], &q = other.weights_[a][cell[a]];
      const std::size_t begin = std::max(first(a, cell), other.first(a, cell));
      double value = 0, derivative = 0;
      for (std::size_t n = begin; n - first(a, cell) < p.value.size() && n - other.first(a, cell) < q.value.size();
           ++n) {
        const std::size_t i = n - first(a, cell), j = n - other.first(a, cell);
        value += p.value[i] * q.value[j];
        derivative += p.derivative[i] * q.derivative[j];
      }
      result.value *= value;
      result.derivative *= a == 0 ? derivative : value;
    }
    return result;
  }

  /// Variances of the difference to another, for the same noise.
  Covariance change(const Spline_probe& other, const Cell& cell) const {
    const Covariance p = covariance(*this, cell), q = other.covariance(other, cell), pq = covariance(other, cell);
    return {std::max(0.0, p.value + q.value - 2 * pq.value),
            std::max(0.0, p.derivative + q.derivative - 2 * pq.derivative)};
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

} // namespace equiaffine::internal

#endif
