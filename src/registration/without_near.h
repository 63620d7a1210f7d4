// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef EQUIAFFINE_SRC_REGISTRATION_WITHOUT_NEAR_H
#define EQUIAFFINE_SRC_REGISTRATION_WITHOUT_NEAR_H

#include <algorithm>
#include <cstddef>
#include <vector>

namespace equiaffine::internal {

/// Returns elements in their order, the first `most` of those that are not near one before them.
template <class T, class Is_near>
std::vector<T> without_near(const std::vector<T>& elements, std::size_t most, const Is_near& is_near) {
  std::vector<T> result;
  for (const T& element : elements) {
    if (result.size() == most) break;
    if (std::none_of(result.begin(), result.end(), [&](const T& other) { return is_near(element, other); }))
      result.push_back(element);
  }
  return result;
}

} // namespace equiaffine::internal

#endif
