// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SPLINE_DISTURBANCES_3_H
#define EQUIAFFINE_VOLUME_INTERNAL_SPLINE_DISTURBANCES_3_H

#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/monomials_3.h>
#include <equiaffine/volume/Spline_function_3.h>
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

namespace equiaffine {

/// Computes the effect of white noise of the samples on the expansions of a spline, as 35 independent disturbances of
/// the expansion in the middle of a cell, one per Taylor coefficient. The sum of the disturbances, each multiplied by
/// an independent normal variable, has the covariance that the noise gives the Taylor coefficients.
///
/// The spline is a tensor product, and so is the covariance: the disturbances are the columns of its Cholesky factor,
/// which is the product of one factor of order 5 per axis. Cells of the same kind share them.
template <class Kernel>
class Spline_disturbances_3 {
public:
  using FT = typename Kernel::FT;

  /// The samples of the spline have been smoothed by the scale `smoothing`. Before that, they had noise with the given
  /// standard deviation, in their unit.
  Spline_disturbances_3(const Spline_function_3<Kernel>& spline, const FT& smoothing, const FT& noise_deviation) {
    const internal::Spline_rule<FT> rule{spline.degree(), spline.scheme(), spline.border_degree(), smoothing};
    for (std::size_t a = 0; a < 3; ++a)
      if (const std::size_t nodes = spline.lattice().size()[a]; nodes > std::size_t(rule.degree))
        factors_[a] =
            internal::noise_factors(internal::Line_functionals<FT>(nodes, rule), a == 0 ? noise_deviation : FT(1));
  }

  /// The disturbance with the number (i, j, k), i + j + k <= 4, of an expansion in lattice coordinates; see
  /// `Spline_function_3::cell_of` for the cell and `Spline_function_3::to_space`.
  Jet_3<FT> operator()(const std::array<std::size_t, 3>& cell, const std::array<int, 3>& column) const {
    std::array<const internal::Noise_factor<FT>*, 3> l;
    for (std::size_t a = 0; a < 3; ++a) l[a] = &factors_[a][cell[a]];
    Jet_3<FT> jet(FT(0));
    for (std::size_t n = 0; n < jet.size; ++n) {
      const auto [i, j, k] = internal::monomials[n];
      jet.coefficients()[n] = (*l[0])[std::size_t(i)][std::size_t(column[0])] *
                              (*l[1])[std::size_t(j)][std::size_t(column[1])] *
                              (*l[2])[std::size_t(k)][std::size_t(column[2])];
    }
    return jet;
  }

private:
  std::array<internal::Per_kind_of_cell<internal::Noise_factor<FT>>, 3> factors_;
};

} // namespace equiaffine

#endif
