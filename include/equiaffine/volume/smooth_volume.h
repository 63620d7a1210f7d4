// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_VOLUME_SMOOTH_VOLUME_H
#define EQUIAFFINE_VOLUME_SMOOTH_VOLUME_H

#include <equiaffine/Volume_3.h>
#include <equiaffine/base/internal/shared/check_argument.h>
#include <equiaffine/volume/internal/local_polynomial.h>
#include <equiaffine/volume/internal/separable_filter.h>

#include <CGAL/tags.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace equiaffine {

/// Returns a volume with less noise: along each axis every sample is replaced by the value of the polynomial of degree
/// 7 that fits its neighbors by least squares. Neighbors are weighted by a bell with the standard deviation `scale` >=
/// 0, in steps of the lattice, that ends at 3.3 times this (Savitzky, Golay 1964 with other weights). Smooth functions
/// change by O(h^8), since polynomials of degree 7 do not change, at the border too. A scale of 1 or less changes
/// nothing. White noise in fourth derivatives falls as scale^-5.5. A node whose window has a sample that is not finite
/// gets one that is not finite.
///
/// \throw std::invalid_argument unless the scale is finite and not negative, and there are as many values as nodes
///
/// Takes 20 scale operations per node. The result does not depend on the number of threads.
template <class ConcurrencyTag = CGAL::Parallel_if_available_tag, class Kernel>
Volume_3<Kernel> smooth_volume(Volume_3<Kernel> volume, const typename Kernel::FT& scale) {
  using FT = typename Kernel::FT;
  using Filter = internal::Smoothing_filter<FT>;
  check_argument(scale >= 0 && scale - scale == 0,
                 "the scale that a volume is smoothed by is not a number of 0 or more: choose one");
  check_argument(volume.values.size() == volume.lattice.number_of_nodes(),
                 "a volume has not as many values as its lattice has nodes: choose the lattice that it has");
  if (scale <= 1) return volume;
  const auto& size = volume.lattice.size();
  const std::array<Filter, 3> filters = {Filter(scale, size[0]), Filter(scale, size[1]), Filter(scale, size[2])};
  Volume_3<Kernel> result{volume.lattice, std::vector<FT>(volume.values.size())};
  internal::Separable_filter<ConcurrencyTag, FT, Filter>(size, 0, result.values.data())(
      {&filters[0], &filters[1], &filters[2]}, volume.values.data());
  return result;
}

} // namespace equiaffine

#endif
