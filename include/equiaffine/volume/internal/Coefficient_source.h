// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_COEFFICIENT_SOURCE_H
#define EQUIAFFINE_VOLUME_INTERNAL_COEFFICIENT_SOURCE_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Volume_view_3.h>
#include <equiaffine/volume/internal/Spline_coefficients.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <utility>

namespace equiaffine::internal {

/// A volume as the source of spline coefficients: those of all its cells, which are computed when they are first asked for,
/// or those of a block of cells alone. Of a part of a volume, all cells are those whose coefficients it determines.
template <class Kernel>
class Coefficient_source {
public:
  using Coefficients = Spline_coefficients<typename Kernel::FT>;

  template <class ConcurrencyTag>
  Coefficient_source(Volume_view_3<Kernel> volume, const Spline_fit& fit, ConcurrencyTag)
      : volume_(std::move(volume)), fit_(fit), cells_(Coefficients::computable_cells(volume_, fit_)),
        compute_(&compute<ConcurrencyTag>) {}

  const Cell_block& cells() const { return cells_; } ///< all cells

  /// The coefficients of all cells. It may be called from many threads at once.
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

  /// The coefficients of a block of cells alone, which must be among all cells.
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
