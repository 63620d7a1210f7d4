// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_LINE_FUNCTIONALS_H
#define EQUIAFFINE_VOLUME_INTERNAL_LINE_FUNCTIONALS_H

#include <equiaffine/volume/internal/bspline.h>
#include <equiaffine/volume/internal/bspline_evaluation.h>
#include <equiaffine/volume/smooth_volume.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// How the samples of a line become a spline: they are smoothed by a scale in steps (0 for none), then a scheme with
/// two degrees computes the coefficients.
template <class FT>
struct Spline_rule {
  int degree;
  Spline_scheme scheme;
  int border_degree; ///< the degree of the polynomials beyond the border, see Volume_survey.h
  FT smoothing;
};

/// The kinds of the cells of a line. Cells of the same kind depend in the same way on the samples around them. Each
/// cell near an end is a kind of its own; all cells between are of one kind.
///
/// The index of a kind is that of its representative: a cell in a line of `kinds` cells.
struct Cell_kinds {
  std::size_t cells = 0, kinds = 0;

  std::size_t operator()(std::size_t cell) const {
    const std::size_t half = kinds / 2;
    if (cells == kinds || cell < half) return cell;
    return std::max(half, cell + kinds > cells ? cell + kinds - cells : 0);
  }
};

/// The effect of the samples of a line on a tensor product spline along one axis. The Taylor coefficients of order 0
/// .. 4 in the middle of a cell are linear functionals of the samples; this class has their coefficients. A line
/// longer than the reach of both borders is represented by a shorter one.
template <class FT>
class Line_functionals {
public:
  static constexpr std::size_t orders = 5;
  using Rows = std::array<std::vector<FT>, orders>;

  /// Precondition: nodes > rule.degree.
  Line_functionals(std::size_t nodes, const Spline_rule<FT>& rule)
      : cells_(nodes - 1), nodes_(std::min(nodes, sufficient_nodes(rule))) {
    const std::vector<FT> samples = smoothed_unit_samples(rule);
    coefficients_.resize((nodes_ + 2 * std::size_t(spline_padding(rule.degree))) * nodes_);
    with_degree(rule.degree, [&](auto n) {
      with_line_filter<FT, n>(rule.scheme, rule.border_degree, [&](const auto& filter) {
        filter.apply(samples.data(), nodes_, nodes_, coefficients_.data(), nodes_);
      });
      const Bspline_taylor<n, 4, FT> basis(FT(0.5));
      for (std::size_t d = 0; d < orders; ++d) basis_[d].assign(basis.rows[d], basis.rows[d] + n + 1);
    });
  }

  /// The functionals of a kind of cells. Row d has the Taylor coefficient of order d in the representative of the
  /// kind, one entry for each sample of the representative line.
  Rows rows(std::size_t kind) const {
    Rows rows;
    for (std::size_t d = 0; d < orders; ++d) {
      rows[d].resize(nodes_);
      for (std::size_t r = 0; r < basis_[d].size(); ++r)
        for (std::size_t j = 0; j < nodes_; ++j) rows[d][j] += basis_[d][r] * coefficients_[(kind + r) * nodes_ + j];
    }
    return rows;
  }

  /// The sum of the magnitudes of all terms of the Taylor coefficient of order d for samples of magnitude 1, which
  /// bounds the effect of rounding. It is at least the sum of magnitudes over the row, in which terms have canceled.
  FT gain(std::size_t kind, std::size_t d) const {
    FT sum = 0;
    for (std::size_t r = 0; r < basis_[d].size(); ++r)
      for (std::size_t j = 0; j < nodes_; ++j) sum += std::abs(basis_[d][r] * coefficients_[(kind + r) * nodes_ + j]);
    return sum;
  }

  Cell_kinds kinds() const { return {cells_, nodes_ - 1}; }

private:
  /// The number of nodes of a line that has room for both borders: the windows of the smoothing, and the reaches of
  /// the filter and of the spline. A recursive filter has decayed to 0.61^40 = 3e-9 after 40 nodes.
  static std::size_t sufficient_nodes(const Spline_rule<FT>& rule) {
    const std::size_t decay = rule.scheme == Spline_scheme::INTERPOLATION ? 40 : 0;
    return 2 * (2 * Smoothing_filter<FT>::radius_of(rule.smoothing) + 2 * std::size_t(rule.degree + 1) + decay) + 2;
  }

  /// The smoothed samples of the line as linear functions of the samples: row i has the coefficients of smoothed
  /// sample i.
  std::vector<FT> smoothed_unit_samples(const Spline_rule<FT>& rule) const {
    std::vector<FT> unit(nodes_ * nodes_);
    for (std::size_t i = 0; i < nodes_; ++i) unit[i * (nodes_ + 1)] = 1;
    if (!(rule.smoothing > 1)) return unit;
    std::vector<FT> smoothed(unit.size());
    Smoothing_filter<FT>(rule.smoothing, nodes_, rule.border_degree)
        .apply(unit.data(), nodes_, nodes_, smoothed.data(), nodes_);
    return smoothed;
  }

  std::size_t cells_;                         // of the line
  std::size_t nodes_;                         // of the representative line
  std::vector<FT> coefficients_;              // row i: spline coefficient i as a linear function of the samples
  std::array<std::vector<FT>, orders> basis_; // Taylor coefficients of the B-splines in the middle of a cell
};

/// One value for each cell of a line, which is the same for all cells of a kind.
template <class T>
class Per_kind_of_cell {
public:
  Per_kind_of_cell() = default;

  /// Stores `make(kind)` for every kind.
  template <class Make>
  Per_kind_of_cell(const Cell_kinds& kinds, const Make& make) : kinds_(kinds) {
    for (std::size_t kind = 0; kind < kinds.kinds; ++kind) values_.push_back(make(kind));
  }

  const T& operator[](std::size_t cell) const { return values_[kinds_(cell)]; }

  std::size_t kind(std::size_t cell) const { return kinds_(cell); }

  /// The kind of the cells between the borders, and also its representative.
  std::size_t inner_kind() const { return kinds_.kinds / 2; }

  /// The offset of a cell from the representative cell of its kind.
  std::size_t offset_from_representative(std::size_t cell) const { return cell - kinds_(cell); }

private:
  Cell_kinds kinds_;
  std::vector<T> values_;
};

} // namespace equiaffine::internal

#endif
