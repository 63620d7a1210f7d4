// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_LINE_FUNCTIONALS_H
#define EQUIAFFINE_VOLUME_INTERNAL_LINE_FUNCTIONALS_H

#include <equiaffine/volume/internal/bspline_evaluation.h>
#include <equiaffine/volume/internal/bspline_interpolation.h>
#include <equiaffine/volume/internal/local_polynomial.h>

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
  int border_degree; ///< see border_degree.h
  FT smoothing;
};

/// The kinds of the cells of a line: near its ends each cell is of its own, those in between are all alike.
struct Kinds_of_cells {
  std::size_t cells = 0, kinds = 0;

  std::size_t operator()(std::size_t cell) const {
    const std::size_t half = kinds / 2;
    if (cells == kinds || cell < half) return cell;
    return std::max(half, cell + kinds > cells ? cell + kinds - cells : 0);
  }
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
      with_line_filter<FT, n>(rule.scheme, rule.border_degree, [&](const auto& filter) {
        filter.apply(unit.data(), nodes_, nodes_, coefficients_.data(), nodes_);
      });
      const Bspline_taylor<n, 4, FT> basis(FT(0.5));
      for (std::size_t d = 0; d < orders; ++d) basis_[d].assign(basis.rows[d], basis.rows[d] + n + 1);
    });
  }

  /// Those of a kind of cells, from the samples of a line of `length()` nodes, the `kind`-th cell of which is one.
  Rows rows(std::size_t kind) const {
    Rows rows;
    for (std::size_t d = 0; d < orders; ++d) {
      rows[d].resize(nodes_);
      for (std::size_t r = 0; r < basis_[d].size(); ++r)
        for (std::size_t j = 0; j < nodes_; ++j) rows[d][j] += basis_[d][r] * coefficients_[(kind + r) * nodes_ + j];
    }
    return rows;
  }

  /// The sum of the sizes of all terms of the Taylor coefficient of order d, for samples of size 1: how much it can be
  /// changed by rounding. At least that of the row, in which terms have been cancelled.
  FT gain(std::size_t kind, std::size_t d) const {
    FT sum = 0;
    for (std::size_t r = 0; r < basis_[d].size(); ++r)
      for (std::size_t j = 0; j < nodes_; ++j) sum += std::abs(basis_[d][r] * coefficients_[(kind + r) * nodes_ + j]);
    return sum;
  }

  std::size_t length() const { return nodes_; }

  /// Cells of the same kind have the same functionals.
  Kinds_of_cells kinds() const { return {cells_, nodes_ - 1}; }

private:
  /// Window of the smoothing, reach of the filter and of the spline; a recursive filter has decayed to 0.61^40 = 3e-9.
  static std::size_t sufficient_nodes(const Spline_rule<FT>& rule) {
    const std::size_t decay = rule.scheme == Spline_scheme::INTERPOLATION ? 40 : 0;
    return 2 * (2 * Smoothing_filter<FT>::radius_of(rule.smoothing) + 2 * std::size_t(rule.degree + 1) + decay) + 2;
  }

  std::size_t cells_, nodes_;
  std::vector<FT> coefficients_; // of the line: row i is coefficient i as a function of the samples
  std::array<std::vector<FT>, orders> basis_;
};

/// Something for every cell of a line, made once per kind.
template <class T>
class Per_kind_of_cell {
public:
  Per_kind_of_cell() = default;

  /// Of `make(kind)`.
  template <class Make>
  Per_kind_of_cell(const Kinds_of_cells& kinds, const Make& make) : kinds_(kinds) {
    for (std::size_t kind = 0; kind < kinds.kinds; ++kind) things_.push_back(make(kind));
  }

  const T& operator[](std::size_t cell) const { return things_[kinds_(cell)]; }

  /// Of a cell from the one of its kind that `make` was called for.
  std::size_t distance(std::size_t cell) const { return cell - kinds_(cell); }

private:
  Kinds_of_cells kinds_;
  std::vector<T> things_;
};

} // namespace equiaffine::internal

#endif
