// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SEPARABLE_FILTER_H
#define EQUIAFFINE_VOLUME_INTERNAL_SEPARABLE_FILTER_H

#include <equiaffine/base/internal/parallel_for.h>
#include <equiaffine/volume/Volume_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// Applies a filter of lines, such as Line_filter::apply, along each axis of the size[0] x size[1] x size[2] known
/// samples of a volume. The result `to` has `padding` additional nodes at each end of each axis.
template <class ConcurrencyTag, class Kernel, class Filter>
class Separable_filter {
public:
  using FT = typename Kernel::FT;
  using Size = std::array<std::size_t, 3>;

  Separable_filter(const Size& size, std::size_t padding, FT* to)
      : size_(size), row_(size[0] + 2 * padding), slab_(row_ * (size[1] + 2 * padding)), padding_(padding), to_(to) {}

  void operator()(const std::array<const Filter*, 3>& filters, const Volume_view_3<Kernel>& volume) const {
    const std::size_t ny = size_[1], nz = size_[2];
    const auto& known = volume.cells().first;
    constexpr std::size_t planes_at_once = Volume_view_3<Kernel>::planes_at_once;
    parallel_for<ConcurrencyTag>(0, (nz + planes_at_once - 1) / planes_at_once, [&](std::size_t n) {
      const std::size_t first = n * planes_at_once, planes = std::min(planes_at_once, size_[2] - first);
      std::vector<FT> samples(size_[0] * planes);
      for (std::size_t j = 0; j < size_[1]; ++j) {
        volume.copy_block({known[0], known[1] + j, known[2] + first}, {size_[0], 1, planes}, samples);
        for (std::size_t k = 0; k < planes; ++k)
          filters[0]->apply(&samples[k * size_[0]], size_[0], 1,
                            to_ + (first + k + padding_) * slab_ + (j + padding_) * row_, 1);
      }
    });
    parallel_for<ConcurrencyTag>(0, nz,
                                 [&](std::size_t k) { in_place(*filters[1], to_ + (k + padding_) * slab_, ny, row_); });
    parallel_for<ConcurrencyTag>(0, ny + 2 * padding_,
                                 [&](std::size_t j) { in_place(*filters[2], to_ + j * row_, nz, slab_); });
  }

private:
  /// Filters `count` rows across, which are `stride` apart after `padding` empty ones.
  void in_place(const Filter& filter, FT* rows, std::size_t count, std::size_t stride) const {
    std::vector<FT> samples(count * row_);
    for (std::size_t i = 0; i < count; ++i) std::copy_n(rows + (i + padding_) * stride, row_, &samples[i * row_]);
    filter.apply(samples.data(), count, row_, rows, stride);
  }

  Size size_;
  std::size_t row_, slab_, padding_;
  FT* to_;
};

} // namespace equiaffine::internal

#endif
