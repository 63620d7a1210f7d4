// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_NOISE_FACTOR_H
#define EQUIAFFINE_VOLUME_INTERNAL_NOISE_FACTOR_H

#include <equiaffine/volume/internal/Line_functionals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// The lower triangular Cholesky factor of the covariance of the Taylor coefficients of order 0 .. 4 along one axis:
/// `factor[d][p]`, p <= d.
template <class FT>
using Noise_factor = std::array<std::array<FT, Line_functionals<FT>::orders>, Line_functionals<FT>::orders>;

/// The sum of the products of two vectors.
template <class FT>
FT dot(const std::vector<FT>& a, const std::vector<FT>& b) {
  FT sum = 0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += a[j] * b[j];
  return sum;
}

/// The factor for Taylor coefficients that are the linear functions `rows` of samples with independent errors of that
/// standard deviation.
template <class FT>
Noise_factor<FT> noise_factor(const typename Line_functionals<FT>::Rows& rows, FT deviation) {
  constexpr std::size_t orders = Line_functionals<FT>::orders;
  Noise_factor<FT> l{};
  for (std::size_t d = 0; d < orders; ++d)
    for (std::size_t p = 0; p <= d; ++p) {
      FT sum = dot(rows[d], rows[p]);
      for (std::size_t q = 0; q < p; ++q) sum -= l[d][q] * l[p][q];
      l[d][p] = p == d ? std::sqrt(std::max(sum, FT(0))) : l[p][p] > 0 ? sum / l[p][p] : FT(0);
    }
  for (auto& row : l)
    for (FT& x : row) x *= deviation;
  return l;
}

/// The factors of all cells along one axis.
template <class FT>
Per_kind_of_cell<Noise_factor<FT>> noise_factors(const Line_functionals<FT>& line, FT deviation) {
  return {line.kinds(), [&](std::size_t kind) { return noise_factor<FT>(line.rows(kind), deviation); }};
}

} // namespace equiaffine::internal

#endif
