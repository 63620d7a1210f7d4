// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SPLINE_COEFFICIENTS_H
#define EQUIAFFINE_VOLUME_INTERNAL_SPLINE_COEFFICIENTS_H

#include <equiaffine/base/Input_error.h>
#include <equiaffine/base/internal/large_pages.h>
#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/number/Jet_3.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_options.h>
#include <equiaffine/volume/internal/bspline.h>
#include <equiaffine/volume/internal/bspline_evaluation.h>
#include <equiaffine/volume/internal/separable_filter.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// How samples become coefficients: the degree of the spline, the scheme, and the degree of the polynomials that
/// extend the samples beyond the border (Volume_survey.h).
struct Spline_fit {
  int degree;
  Spline_scheme scheme;
  int border_degree;

  /// Calls f(filter) with the filter that turns a line of samples into coefficients.
  template <class FT, class F>
  void with_filter(const F& f) const {
    with_degree(degree, [&](auto n) { with_line_filter<FT, n>(scheme, border_degree, f); });
  }
};

/// The coefficients of a tensor product spline in a block of cells, (n + 1)^3 for each cell. Coefficient 0 is the
/// first one beyond the border of the lattice: cell i has the coefficients i to i + n along an axis.
template <class FT>
class Spline_coefficients {
public:
  using Size = std::array<std::size_t, 3>;

  /// Computes the coefficients of all cells of a volume in parallel.
  template <class ConcurrencyTag, class Kernel>
  static Spline_coefficients of_all_cells(const Volume_view_3<Kernel>& volume, const Spline_fit& fit) {
    const Size& nodes = volume.lattice().size();
    Spline_coefficients result(fit.degree, {{}, {nodes[0] - 1, nodes[1] - 1, nodes[2] - 1}});
    fit.with_filter<FT>([&](const auto& line) {
      using Filter = std::decay_t<decltype(line)>;
      Separable_filter<ConcurrencyTag, Kernel, Filter>(nodes, Filter::padding,
                                                       result.values_.get())({&line, &line, &line}, volume);
    });
    const std::size_t slab = result.size_[0] * result.size_[1];
    parallel_for<ConcurrencyTag>(0, result.size_[2], [&](std::size_t k) { result.remove_infinities(k * slab, slab); });
    return result;
  }

  /// Computes the coefficients of a block of cells from the samples on which they depend, with the same bits as
  /// of_all_cells(). \pre the scheme is not interpolation, whose coefficients depend on all samples
  template <class Kernel>
  static Spline_coefficients of_cells(const Volume_view_3<Kernel>& volume, const Spline_fit& fit,
                                      const Cell_block& cells) {
    Spline_coefficients result(fit.degree, cells);
    fit.with_filter<FT>([&](const auto& line) {
      if constexpr (requires { line.samples_of({}, 0); }) result.filter(line, volume);
    });
    result.remove_infinities(0, result.size_[0] * result.size_[1] * result.size_[2]);
    return result;
  }

  /// The cells whose coefficients depend only on known samples: all cells if the whole volume is known. \throw
  /// std::invalid_argument if there are none
  template <class Kernel>
  static Cell_block computable_cells(const Volume_view_3<Kernel>& volume, const Spline_fit& fit) {
    if (!volume.is_part()) return volume.cells();
    check_argument(
        fit.scheme != Spline_scheme::INTERPOLATION,
        "spline interpolation needs all samples of a volume, but some are unknown: choose quasi-interpolation");
    Cell_block cells = volume.cells();
    fit.with_filter<FT>([&](const auto& line) {
      if constexpr (requires { line.samples_of({}, 0); })
        for (std::size_t a = 0; a < 3; ++a) {
          const Line_part known = nodes_of(volume.cells(), a);
          const auto is_computable = [&](std::size_t cell) {
            const Line_part used =
                line.samples_of({cell, cell + 1 + std::size_t(fit.degree)}, volume.lattice().size()[a]);
            return known.first <= used.first && used.end <= known.end;
          };
          auto &first = cells.first[a], &end = cells.end[a];
          while (first < end && !is_computable(first)) ++first;
          while (first < end && !is_computable(end - 1)) --end;
          check_argument(first < end, "too few samples of a volume for a spline in a cell: provide more of them, see "
                                      "cells_to_know()");
        }
    });
    return cells;
  }

  const Cell_block& cells() const { return cells_; }

  const FT* data() const { return values_.get(); }
  const Size& size() const { return size_; }

  /// The expansion in lattice coordinates at an offset in a cell of the block.
  template <int Order>
  Jet_3<FT, Order> expansion(const Size& cell, const std::array<FT, 3>& offset) const {
    Jet_3<FT, Order> jet;
    const std::size_t i = cell[0] - cells_.first[0], j = cell[1] - cells_.first[1], k = cell[2] - cells_.first[2];
    const FT* first = &values_[(k * size_[1] + j) * size_[0] + i];
    with_degree(degree_,
                [&](auto n) { contract<n, Order>(first, size_[0], size_[0] * size_[1], offset, jet.coefficients()); });
    return jet;
  }

  /// The maximum magnitude of the coefficients of a cell of the block.
  FT greatest(const Size& cell) const {
    const std::size_t i = cell[0] - cells_.first[0], j = cell[1] - cells_.first[1], k = cell[2] - cells_.first[2];
    const auto taps = std::size_t(degree_) + 1;
    FT result(0);
    for (std::size_t z = 0; z < taps; ++z)
      for (std::size_t y = 0; y < taps; ++y) {
        const FT* const row = &values_[((k + z) * size_[1] + j + y) * size_[0] + i];
        for (std::size_t x = 0; x < taps; ++x) result = std::max(result, std::abs(row[x]));
      }
    return result;
  }

  /// The trilinear interpolation of the expansions at the corners of a cell.
  template <int Order>
  Jet_3<FT, Order> interpolated_expansion(const Size& cell, const std::array<FT, 3>& offset) const {
    Jet_3<FT, Order> sum(FT(0));
    for (unsigned corner = 0; corner < 8; ++corner) {
      std::array<FT, 3> corner_offset;
      FT weight = 1;
      for (std::size_t a = 0; a < 3; ++a) {
        corner_offset[a] = FT(corner >> a & 1);
        weight *= corner >> a & 1 ? offset[a] : 1 - offset[a];
      }
      const auto jet = expansion<Order>(cell, corner_offset);
      for (std::size_t n = 0; n < jet.size; ++n) sum.coefficients()[n] += weight * jet.coefficients()[n];
    }
    return sum;
  }

private:
  Spline_coefficients(int degree, const Cell_block& cells) : degree_(degree), cells_(cells) {
    for (std::size_t a = 0; a < 3; ++a) size_[a] = cells.end[a] - cells.first[a] + std::size_t(degree);
    const std::size_t count = size_[0] * size_[1] * size_[2];
    values_ = numbers(count + overread);
    std::fill_n(&values_[count], overread, FT(0));
    advise_large_pages(values_.get(), count * sizeof(FT));
  }

  /// Uninitialized numbers.
  static std::unique_ptr<FT[]> numbers(std::size_t count) { return std::unique_ptr<FT[]>(new FT[count]); }

  /// The range of the block's coefficients along an axis.
  Line_part part(std::size_t axis) const { return {cells_.first[axis], cells_.first[axis] + size_[axis]}; }

  /// Filters the samples around the block along x and y plane by plane, then all planes along z.
  template <class Filter, class Kernel>
  void filter(const Filter& line, const Volume_view_3<Kernel>& volume) {
    const Size& nodes = volume.lattice().size();
    std::array<Line_part, 3> given;
    for (std::size_t a = 0; a < 3; ++a) given[a] = line.samples_of(part(a), nodes[a]);
    const auto& [x, y, z] = given;
    const std::size_t slab = size_[0] * size_[1];
    constexpr std::size_t planes_at_once = Volume_view_3<Kernel>::planes_at_once;
    const std::size_t plane = x.size() * y.size();
    const auto samples = numbers(planes_at_once * plane), along_y = numbers(z.size() * slab);
    std::vector<FT> along_x(y.size() * size_[0]);
    for (std::size_t k = z.first; k < z.end; ++k) {
      const std::size_t n = (k - z.first) % planes_at_once;
      if (n == 0) {
        const std::size_t planes = std::min(planes_at_once, z.end - k);
        volume.copy_block({x.first, y.first, k}, {x.size(), y.size(), planes}, {samples.get(), planes * plane});
      }
      for (std::size_t j = 0; j < y.size(); ++j)
        line.apply_to_part(&samples[n * plane + j * x.size()], x, nodes[0], 1, part(0), &along_x[j * size_[0]], 1);
      line.apply_to_part(along_x.data(), y, nodes[1], size_[0], part(1), &along_y[(k - z.first) * slab], size_[0]);
    }
    line.apply_to_part(along_y.get(), z, nodes[2], slab, part(2), values_.get(), slab);
  }

  /// Replaces infinities by NaN: an infinity could pass as a value.
  void remove_infinities(std::size_t first, std::size_t count) {
    for (FT& x : std::span(&values_[first], count))
      if (!std::isfinite(x)) x = std::numeric_limits<FT>::quiet_NaN();
  }

  int degree_;
  Cell_block cells_;
  Size size_;
  std::unique_ptr<FT[]> values_;
};

/// Computes the spline coefficients of a volume: those of all its cells on first use, or those of a block of cells.
/// For a part of a volume, all cells are those whose coefficients the part determines.
template <class Kernel>
class Coefficient_source {
public:
  using Coefficients = Spline_coefficients<typename Kernel::FT>;

  template <class ConcurrencyTag>
  Coefficient_source(Volume_view_3<Kernel> volume, const Spline_fit& fit, ConcurrencyTag)
      : volume_(std::move(volume)), fit_(fit), cells_(Coefficients::computable_cells(volume_, fit_)),
        compute_(&compute<ConcurrencyTag>) {}

  const Cell_block& cells() const { return cells_; } ///< all cells

  /// The coefficients of all cells. Thread-safe.
  const Coefficients& all() const {
    if (const Coefficients* const computed = all_if_computed()) return *computed;
    const std::lock_guard lock(mutex_);
    if (!coefficients_) {
      coefficients_.emplace(volume_.is_part() ? of_cells(cells_) : compute_(volume_, fit_));
      is_computed_.store(true, std::memory_order_release);
    }
    return *coefficients_;
  }

  const Coefficients* all_if_computed() const {
    return is_computed_.load(std::memory_order_acquire) ? &*coefficients_ : nullptr;
  }

  /// The coefficients of a block of cells(). \pre the block lies in cells()
  Coefficients of_cells(const Cell_block& cells) const { return Coefficients::of_cells(volume_, fit_, cells); }

private:
  template <class ConcurrencyTag>
  static Coefficients compute(const Volume_view_3<Kernel>& volume, const Spline_fit& fit) {
    std::optional<Coefficients> result;
    isolated<ConcurrencyTag>([&] { result.emplace(Coefficients::template of_all_cells<ConcurrencyTag>(volume, fit)); });
    return *std::move(result);
  }

  Volume_view_3<Kernel> volume_;
  Spline_fit fit_;
  Cell_block cells_;
  Coefficients (*compute_)(const Volume_view_3<Kernel>&, const Spline_fit&);
  mutable std::mutex mutex_;
  mutable std::atomic<bool> is_computed_ = false;
  mutable std::optional<Coefficients> coefficients_;
};

} // namespace equiaffine::internal

#endif
