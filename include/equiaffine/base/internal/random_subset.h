// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_BASE_INTERNAL_RANDOM_SUBSET_H
#define EQUIAFFINE_BASE_INTERNAL_RANDOM_SUBSET_H

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace equiaffine {

/// Returns `count` of the numbers below `size`, or all of them, in random order, which `seed` decides.
template <class Index = std::size_t>
std::vector<Index> random_subset(std::size_t size, std::size_t count, unsigned seed) {
  std::vector<Index> indices(size);
  std::iota(indices.begin(), indices.end(), Index(0));
  count = std::min(count, size);
  std::minstd_rand random(seed);
  for (std::size_t k = 0; k < count; ++k) std::swap(indices[k], indices[k + random() % (size - k)]);
  indices.resize(count);
  return indices;
}

} // namespace equiaffine

#endif
