// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_REGISTRATION_INTERNAL_RANDOM_SUBSET_H
#define EQUIAFFINE_REGISTRATION_INTERNAL_RANDOM_SUBSET_H

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace equiaffine::internal {

/// Returns `count` of the numbers below `size`, or all of them, in random order, which `seed` decides.
inline std::vector<std::size_t> random_subset(std::size_t size, std::size_t count, unsigned seed) {
  std::vector<std::size_t> indices(size);
  std::iota(indices.begin(), indices.end(), std::size_t(0));
  count = std::min(count, size);
  std::minstd_rand random(seed);
  for (std::size_t k = 0; k < count; ++k) std::swap(indices[k], indices[k + random() % (size - k)]);
  indices.resize(count);
  return indices;
}

/// Returns `count` elements, or all of them, in random order.
template <class T>
std::vector<T> random_elements(const std::vector<T>& elements, std::size_t count, unsigned seed) {
  std::vector<T> result;
  for (const std::size_t i : random_subset(elements.size(), count, seed)) result.push_back(elements[i]);
  return result;
}

} // namespace equiaffine::internal

#endif
