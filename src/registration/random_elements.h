// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_RANDOM_ELEMENTS_H
#define EQUIAFFINE_SRC_REGISTRATION_RANDOM_ELEMENTS_H

#include <equiaffine/base/internal/random_subset.h>

#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// Returns `count` elements, or all of them, in random order.
template <class T>
std::vector<T> random_elements(const std::vector<T>& elements, std::size_t count, unsigned seed) {
  std::vector<T> result;
  for (const std::size_t i : random_subset(elements.size(), count, seed)) result.push_back(elements[i]);
  return result;
}

} // namespace equiaffine::internal

#endif
