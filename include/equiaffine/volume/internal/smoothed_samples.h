// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SMOOTHED_SAMPLES_H
#define EQUIAFFINE_VOLUME_INTERNAL_SMOOTHED_SAMPLES_H

#include <equiaffine/base/internal/check_argument.h>
#include <equiaffine/base/internal/large_pages.h>
#include <equiaffine/volume/Cell_block.h>
#include <equiaffine/volume/Volume_3.h>
#include <equiaffine/volume/Volume_view_3.h>
#include <equiaffine/volume/internal/Line_part.h>
#include <equiaffine/volume/internal/local_polynomial.h>
#include <equiaffine/volume/internal/separable_filter.h>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace equiaffine::internal {

/// The smoothed samples of a volume at the nodes that are known, i fastest. They are NaN where not all that they are made
/// of is known. \pre the scale is greater than 1
template <class ConcurrencyTag, class Kernel>
std::vector<typename Kernel::FT> smoothed_samples(const Volume_view_3<Kernel>& volume, const typename Kernel::FT& scale,
                                                  int border_degree) {
  using Filter = Smoothing_filter<typename Kernel::FT>;
  const auto filter = [&](std::size_t a) {
    return Filter(scale, volume.lattice().size()[a], border_degree, nodes_of(volume.cells(), a));
  };
  const std::array<Filter, 3> filters = {filter(0), filter(1), filter(2)};
  std::array<std::size_t, 3> size;
  for (std::size_t a = 0; a < 3; ++a) size[a] = nodes_of(volume.cells(), a).size();
  std::vector<typename Kernel::FT> result;
  resize_with_large_pages(result, size[0] * size[1] * size[2]);
  Separable_filter<ConcurrencyTag, Kernel, Filter>(size, 0, result.data())({&filters[0], &filters[1], &filters[2]},
                                                                           volume);
  return result;
}

/// The part of a volume that is known, smoothed. \pre the scale is greater than 1
template <class ConcurrencyTag, class Kernel>
Volume_view_3<Kernel> smoothed_part(const Volume_view_3<Kernel>& volume, const typename Kernel::FT& scale,
                                    int border_degree) {
  using FT = typename Kernel::FT;
  const Cell_block& known = volume.cells();
  const auto samples =
      std::make_shared<const std::vector<FT>>(smoothed_samples<ConcurrencyTag>(volume, scale, border_degree));
  const std::ptrdiff_t step = sizeof(FT), row = step * std::ptrdiff_t(nodes_of(known, 0).size()),
                       slab = row * std::ptrdiff_t(nodes_of(known, 1).size());
  Cell_block cells;
  for (std::size_t a = 0; a < 3; ++a) {
    const Line_part nodes =
        Smoothing_filter<FT>(scale, volume.lattice().size()[a], border_degree, nodes_of(known, a)).smoothed_nodes();
    check_argument(nodes.size() >= 2, "less samples of a volume are known than its smoothing needs: let more be known");
    cells.first[a] = nodes.first;
    cells.end[a] = nodes.end - 1;
  }
  const std::ptrdiff_t offset = std::ptrdiff_t(cells.first[0] - known.first[0]) * step +
                                std::ptrdiff_t(cells.first[1] - known.first[1]) * row +
                                std::ptrdiff_t(cells.first[2] - known.first[2]) * slab;
  return Volume_view_3<Kernel>::part(volume.lattice(), cells, samples->data() + offset / step, {step, row, slab},
                                     samples);
}

/// Whether a scale changes a volume. \throw std::invalid_argument unless it is finite and not negative
template <class FT>
bool smooths(const FT& scale) {
  check_argument(scale >= 0 && scale - scale == 0,
                 "the scale that a volume is smoothed by is not a number of 0 or more: choose one");
  return scale > 1;
}

} // namespace equiaffine::internal

#endif
