// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_INTERNAL_BSPLINE_FUNCTIONALS_H
#define EQUIAFFINE_INTERNAL_BSPLINE_FUNCTIONALS_H

#include <equiaffine/internal/bspline_evaluation.h>
#include <equiaffine/internal/bspline_interpolation.h>
#include <equiaffine/internal/local_polynomial.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// How samples become a spline: smoothed (a scale in steps, 0 for none), then by a scheme of a degree.
template <class FT>
struct Spline_rule {
  int degree;
  Spline_scheme scheme;
  FT smoothing = 0;
};

/// What one axis of a tensor product spline makes of the samples of a line: the Taylor coefficients of order 0 .. 4 in
/// the middle of a cell are linear functions of the samples, whose coefficients these are. They differ between cells
/// near a border only; long lines have the cells of one that is long enough for both borders.
template <class FT>
class Line_functionals {
public:
  static constexpr std::size_t orders = 5;
  using Rows = std::array<std::vector<FT>, orders>;

  /// Precondition: nodes > rule.degree.
  Line_functionals(std::size_t nodes, const Spline_rule<FT>& rule)
      : cells_(nodes - 1), nodes_(std::min(nodes, sufficient_nodes(rule))) {
    const std::size_t padding = std::size_t(spline_padding(rule.degree));
    std::vector<FT> unit(nodes_ * nodes_);
    for (std::size_t i = 0; i < nodes_; ++i) unit[i * (nodes_ + 1)] = 1; // row i: sample i as a function of all
    if (rule.smoothing > 1) {
      std::vector<FT> smoothed(unit.size());
      Smoothing_filter<FT>(rule.smoothing, nodes_).apply(unit.data(), nodes_, nodes_, smoothed.data(), nodes_);
      unit = std::move(smoothed);
    }
    coefficients_.resize((nodes_ + 2 * padding) * nodes_);
    with_degree(rule.degree, [&](auto n) {
      with_line_filter<FT, n>(rule.scheme, [&](const auto& filter) {
        filter.apply(unit.data(), nodes_, nodes_, coefficients_.data(), nodes_);
      });
      const Bspline_taylor<n, 4, FT> basis(FT(0.5));
      for (std::size_t d = 0; d < orders; ++d) basis_[d].assign(basis.rows[d], basis.rows[d] + n + 1);
    });
  }

  /// Those of a cell, from the samples of a line of `length()` nodes.
  Rows of_cell(std::size_t cell) const {
    const std::size_t c = kind_of_cell(cell);
    Rows rows;
    for (std::size_t d = 0; d < orders; ++d) {
      rows[d].resize(nodes_);
      for (std::size_t r = 0; r < basis_[d].size(); ++r)
        for (std::size_t j = 0; j < nodes_; ++j) rows[d][j] += basis_[d][r] * coefficients_[(c + r) * nodes_ + j];
    }
    return rows;
  }

  /// The sum of the sizes of all terms of the Taylor coefficient of order d, for samples of size 1: how much it can be
  /// changed by rounding. At least that of the row, in which terms have been cancelled.
  FT gain(std::size_t cell, std::size_t d) const {
    const std::size_t c = kind_of_cell(cell);
    FT sum = 0;
    for (std::size_t r = 0; r < basis_[d].size(); ++r)
      for (std::size_t j = 0; j < nodes_; ++j) sum += std::abs(basis_[d][r] * coefficients_[(c + r) * nodes_ + j]);
    return sum;
  }

  std::size_t length() const { return nodes_; }

  /// Cells of the same kind have the same functionals.
  std::size_t number_of_kinds() const { return nodes_ - 1; }
  std::size_t kind_of_cell(std::size_t cell) const {
    const std::size_t half = (nodes_ - 1) / 2, kinds = nodes_ - 1;
    if (cells_ == kinds || cell < half) return cell;
    return std::max(half, cell + kinds > cells_ ? cell + kinds - cells_ : 0);
  }

private:
  /// Window of the smoothing, reach of the filter and of the spline; a recursive filter has decayed to 0.61^40 = 3e-9.
  static std::size_t sufficient_nodes(const Spline_rule<FT>& rule) {
    const std::size_t decay = rule.scheme == Spline_scheme::INTERPOLATION ? 40 : 0;
    const auto window = rule.smoothing > 1 ? std::size_t(std::ceil(4 * rule.smoothing)) : 0;
    return 2 * (2 * window + 2 * std::size_t(rule.degree) + decay) + 2;
  }

  std::size_t cells_, nodes_;
  std::vector<FT> coefficients_; // of the line: row i is coefficient i as a function of the samples
  std::array<std::vector<FT>, orders> basis_;
};

/// The sum of the products of two vectors.
template <class FT>
FT dot(const std::vector<FT>& a, const std::vector<FT>& b) {
  FT sum = 0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += a[j] * b[j];
  return sum;
}

} // namespace equiaffine::internal

#endif
