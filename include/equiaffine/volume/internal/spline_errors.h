// SPDX-License-Identifier: GPL-3.0-or-later
// The effects of noise in the samples and of rounding on the derivatives of a spline.
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SPLINE_ERRORS_H
#define EQUIAFFINE_VOLUME_INTERNAL_SPLINE_ERRORS_H

#include <equiaffine/number/Jet_3.h>
#include <equiaffine/number/internal/monomials_3.h>
#include <equiaffine/volume/Spline_function_3.h>
#include <equiaffine/volume/Volume_survey.h>
#include <equiaffine/volume/internal/Line_functionals.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace equiaffine::internal {

/// The lower triangular Cholesky factor of the covariance of the Taylor coefficients of order 0 .. 4 along one axis:
/// `factor[d][p]`, p <= d.
template <class FT>
using Noise_factor = std::array<std::array<FT, Line_functionals<FT>::orders>, Line_functionals<FT>::orders>;

template <class FT>
FT dot(const std::vector<FT>& a, const std::vector<FT>& b) {
  FT sum = 0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += a[j] * b[j];
  return sum;
}

/// The factor for Taylor coefficients that are the linear functions `rows` of samples with independent errors of the
/// given standard deviation.
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

/// The effect of white noise in the samples on the expansions of a spline, as 35 independent disturbances of the
/// expansion in the middle of a cell, one per Taylor coefficient. The sum of the disturbances, each multiplied by an
/// independent standard normal variable, has the covariance of the Taylor coefficients under the noise.
///
/// The spline is a tensor product, and so is the covariance. The disturbances are the columns of its Cholesky factor,
/// which is the product of one factor of order 5 per axis. Cells of the same kind share them.
template <class Kernel>
class Spline_disturbances_3 {
public:
  using FT = typename Kernel::FT;

  /// The samples of the spline were smoothed by the scale `smoothing`. Before, their noise had the given standard
  /// deviation, in their units.
  Spline_disturbances_3(const Spline_function_3<Kernel>& spline, const FT& smoothing, const FT& noise_deviation) {
    const internal::Spline_rule<FT> rule{spline.degree(), spline.scheme(), spline.border_degree(), smoothing};
    for (std::size_t a = 0; a < 3; ++a)
      if (const std::size_t nodes = spline.lattice().size()[a]; nodes > std::size_t(rule.degree))
        factors_[a] =
            internal::noise_factors(internal::Line_functionals<FT>(nodes, rule), a == 0 ? noise_deviation : FT(1));
  }

  /// Disturbance (i, j, k), i + j + k <= 4, of an expansion in lattice coordinates; see `Spline_function_3::cell_of`
  /// for the cell and `Spline_function_3::to_space`.
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

/// Upper estimates of the effect of rounding on the second derivatives of a spline: two roundings of every term, as
/// if all samples were as large as the largest one, and one rounding of the samples to float if all are floats. The
/// latter dominates by far. It is computed for samples as large as the coefficients of the cell unless they were
/// smoothed.
template <class Kernel>
class Spline_rounding_3 {
public:
  using FT = typename Kernel::FT;
  using Spline = Spline_function_3<Kernel>;
  using Cell = std::array<std::size_t, 3>;

  /// `smoothing` is the scale by which the samples of the spline were smoothed; `samples` is the survey of the
  /// unsmoothed samples.
  Spline_rounding_3(const Spline& spline, const FT& smoothing, const Volume_survey& samples)
      : to_lattice_(spline.to_lattice()),
        rounding_of_terms_(2 * std::numeric_limits<FT>::epsilon() * FT(samples.greatest)),
        rounding_of_samples_(samples.are_floats ? FT(std::numeric_limits<float>::epsilon()) / 2 : FT(0)),
        greatest_sample_(FT(samples.greatest)), is_local_(samples.are_floats && !(smoothing > FT(0))) {
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t nodes = spline.lattice().size()[a];
      if (nodes <= std::size_t(spline.degree())) return;
      const internal::Line_functionals<FT> line(nodes,
                                                {spline.degree(), spline.scheme(), spline.border_degree(), smoothing});
      gains_[a] = {line.kinds(), [&](std::size_t kind) { return gains(line, kind); }};
    }
    inside_ = errors({gains_[0].inner_kind(), gains_[1].inner_kind(), gains_[2].inner_kind()});
  }

  /// The maximum error of a second derivative in the coordinates of space, in the middle of a cell of the spline.
  FT operator()(const Spline& spline, const Cell& cell) const {
    Errors e = inside_;
    for (std::size_t a = 0; a < 3; ++a)
      if (gains_[a].kind(cell[a]) != gains_[a].inner_kind()) {
        e = errors(cell);
        break;
      }
    constexpr FT margin(2); // coefficients are smaller than samples where these oscillate
    const FT greatest =
        is_local_ ? std::min(greatest_sample_, margin * spline.greatest_coefficient(cell)) : greatest_sample_;
    return e.terms + greatest * e.samples;
  }

private:
  /// The maximum errors of second derivatives by rounding of terms, and by rounding of samples of magnitude 1.
  struct Errors {
    FT terms, samples;
  };

  Errors errors(const Cell& cell) const {
    Errors greatest{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = i; j < 3; ++j) {
        Errors sum{};
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b) {
            const FT factor = std::abs(to_lattice_[a][i] * to_lattice_[b][j]);
            const Errors e = errors_in_lattice(a, b, cell);
            sum.terms += factor * e.terms;
            sum.samples += factor * e.samples;
          }
        greatest = {std::max(greatest.terms, sum.terms), std::max(greatest.samples, sum.samples)};
      }
    return greatest;
  }

  /// The maximum change of the value and of the first two derivatives along one axis by errors of magnitude 1 in all
  /// terms, or in all samples.
  struct Gains {
    std::array<FT, 3> terms, samples;
  };

  /// The errors of the second derivative along the axes a and b of the lattice.
  Errors errors_in_lattice(std::size_t a, std::size_t b, const Cell& cell) const {
    FT terms = rounding_of_terms_, samples = rounding_of_samples_;
    for (std::size_t c = 0; c < 3; ++c) {
      const Gains& gains = gains_[c][cell[c]];
      const std::size_t order = std::size_t(a == c) + std::size_t(b == c);
      terms *= gains.terms[order];
      samples *= gains.samples[order];
    }
    return {terms, samples};
  }

  static Gains gains(const internal::Line_functionals<FT>& line, std::size_t kind) {
    const auto rows = line.rows(kind);
    Gains gains{};
    for (std::size_t d = 0; d < 3; ++d) {
      const FT factorial = d == 2 ? FT(2) : FT(1);
      gains.terms[d] = factorial * line.gain(kind, d);
      for (const FT& x : rows[d]) gains.samples[d] += factorial * std::abs(x);
    }
    return gains;
  }

  typename Spline::Matrix to_lattice_;
  FT rounding_of_terms_;   // for terms as large as the largest sample
  FT rounding_of_samples_; // for samples of magnitude 1
  FT greatest_sample_;
  bool is_local_;
  std::array<internal::Per_kind_of_cell<Gains>, 3> gains_;
  Errors inside_{}; // in cells away from the borders
};

} // namespace equiaffine

#endif
