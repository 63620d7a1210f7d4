// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_INTERNAL_SMOOTHED_SAMPLES_H
#define EQUIAFFINE_VOLUME_INTERNAL_SMOOTHED_SAMPLES_H

#include <equiaffine/Volume_3.h>
#include <equiaffine/Volume_view_3.h>
#include <equiaffine/base/internal/shared/check_argument.h>
#include <equiaffine/base/internal/shared/large_pages.h>
#include <equiaffine/volume/internal/local_polynomial.h>
#include <equiaffine/volume/internal/separable_filter.h>

#include <array>

namespace equiaffine::internal {

/// The smoothed samples of a volume. \pre the scale is greater than 1
template <class ConcurrencyTag, class Kernel>
Volume_3<Kernel> smoothed_samples(const Volume_view_3<Kernel>& volume, const typename Kernel::FT& scale) {
  using Filter = Smoothing_filter<typename Kernel::FT>;
  const auto& size = volume.lattice().size();
  const std::array<Filter, 3> filters = {Filter(scale, size[0]), Filter(scale, size[1]), Filter(scale, size[2])};
  Volume_3<Kernel> result{volume.lattice(), {}};
  resize_with_large_pages(result.values, result.lattice.number_of_nodes());
  Separable_filter<ConcurrencyTag, Kernel, Filter>(size, 0, result.values.data())(
      {&filters[0], &filters[1], &filters[2]}, volume);
  return result;
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
